//! Proves from the form of a loop that it ends.
//!
//! A loop is bounded if its body begins with a guard that leaves it unless `counter < bound` (or `>`, `<=`, `>=`); if the
//! counter is a local variable to which the loop stores exactly once, in code that every round runs, and with a constant step
//! in the direction of the bound; and if the bound does not depend on anything that the loop stores. Some loops that end do
//! not satisfy this rule, but it is easy for a reader to check: rewrite the loop rather than the rule.

use std::collections::BTreeSet;

use super::bounds::FunctionPlace;
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Statement,
};

/// Result of the analysis of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum End {
    /// Not proven to end.
    Unproven,
    /// Ends after a number of rounds that depends on data.
    ByData,
    /// Ends after a number of rounds that constants limit.
    ByConstant,
}

/// The results for all loops of a function, in order.
pub(super) fn ends_of_loops(place: FunctionPlace<'_>) -> Vec<End> {
    let mut all = Vec::new();
    ends_in(place, &place.function.body, &mut all);
    all
}

fn ends_in(place: FunctionPlace<'_>, block: &Block, all: &mut Vec<End>) {
    for statement in block.iter() {
        if let Statement::Loop {
            body, continuing, ..
        } = statement
        {
            all.push(end_of(place, body, continuing));
        }
        for child in children(statement) {
            ends_in(place, child, all);
        }
    }
}

pub(super) fn children(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Loop {
            body, continuing, ..
        } => vec![body, continuing],
        Statement::Switch { cases, .. } => cases.iter().map(|c| &c.body).collect(),
        _ => Vec::new(),
    }
}

fn end_of(place: FunctionPlace<'_>, body: &Block, continuing: &Block) -> End {
    let function = place.function;
    let mut stores = Vec::new();
    for block in [body, continuing] {
        stores_in(function, block, &mut stores);
    }
    let mut evaluated = BTreeSet::new();
    for block in [body, continuing] {
        evaluated_in(block, &mut evaluated);
    }
    let steps: Vec<(Handle<LocalVariable>, LoopStep)> = continuing
        .iter()
        .filter_map(|s| step_of(function, s))
        .filter(|(counter, _)| stores.iter().filter(|s| *s == counter).count() == 1)
        .collect();
    let mut end = End::Unproven;
    for (condition, holds) in guards(function, body) {
        for (counter, step) in &steps {
            let Some(bound) = bound_of(function, condition, holds, *counter, *step) else {
                continue;
            };
            if may_move(function, bound, &evaluated, &stores) {
                continue;
            }
            let by_constant = match step {
                LoopStep::Up => place.is_limited(bound) && place.begins_high(*counter, continuing),
                LoopStep::Down => place.begins_low(*counter, continuing),
            };
            end = end.max(if by_constant {
                End::ByConstant
            } else {
                End::ByData
            });
        }
    }
    end
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum LoopStep {
    Up,
    Down,
}

pub(super) fn local(
    function: &Function,
    pointer: Handle<Expression>,
) -> Option<Handle<LocalVariable>> {
    match function.expressions[pointer] {
        Expression::LocalVariable(variable) => Some(variable),
        // A store to an element or a field counts as a store to the whole variable.
        Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
            local(function, base)
        }
        _ => None,
    }
}

/// Appends the local variables to which a block stores, once per store. A call counts as a store to every variable passed by pointer.
fn stores_in(function: &Function, block: &Block, stores: &mut Vec<Handle<LocalVariable>>) {
    for statement in block.iter() {
        match statement {
            Statement::Store { pointer, .. } => stores.extend(local(function, *pointer)),
            Statement::Call { arguments, .. } => {
                stores.extend(arguments.iter().filter_map(|a| local(function, *a)));
            }
            _ => {}
        }
        for child in children(statement) {
            stores_in(function, child, stores);
        }
    }
}

pub(super) fn loaded(
    function: &Function,
    expression: Handle<Expression>,
) -> Option<Handle<LocalVariable>> {
    match function.expressions[expression] {
        Expression::Load { pointer } => match function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        },
        _ => None,
    }
}

/// `counter = counter + constant` or `- constant`.
fn step_of(
    function: &Function,
    statement: &Statement,
) -> Option<(Handle<LocalVariable>, LoopStep)> {
    let Statement::Store { pointer, value } = statement else {
        return None;
    };
    let Expression::LocalVariable(counter) = function.expressions[*pointer] else {
        return None;
    };
    let Expression::Binary { op, left, right } = function.expressions[*value] else {
        return None;
    };
    let step = match function.expressions[right] {
        Expression::Literal(Literal::U32(n)) => i64::from(n),
        Expression::Literal(Literal::I32(n)) => i64::from(n),
        _ => 0,
    };
    let direction = match op {
        BinaryOperator::Add => LoopStep::Up,
        BinaryOperator::Subtract => LoopStep::Down,
        _ => return None,
    };
    (step > 0 && loaded(function, left) == Some(counter)).then_some((counter, direction))
}

/// Conditions for a round to continue, from the body's first break; each must be true or, if paired with `false`, must be false.
fn guards(function: &Function, body: &Block) -> Vec<(Handle<Expression>, bool)> {
    let mut found = Vec::new();
    let mut before: Vec<&Statement> = Vec::new();
    for statement in body.iter() {
        match statement {
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                if leaves(reject) {
                    conjuncts(function, *condition, &before, &mut found);
                    return found;
                }
                if leaves(accept) {
                    found.push((*condition, false));
                    return found;
                }
                before.push(statement);
            }
            Statement::Emit(_) => {}
            // Only the evaluation of the condition may precede the break.
            _ => return found,
        }
    }
    found
}

fn leaves(block: &Block) -> bool {
    matches!(
        block.last(),
        Some(Statement::Break | Statement::Return { .. })
    )
}

/// naga compiles `a && b` to a variable that is false unless `a` holds and `b` was stored.
fn conjuncts(
    function: &Function,
    condition: Handle<Expression>,
    before: &[&Statement],
    found: &mut Vec<(Handle<Expression>, bool)>,
) {
    let stored = |block: &Block, variable| {
        block.iter().rev().find_map(|s| match s {
            Statement::Store { pointer, value } if local(function, *pointer) == Some(variable) => {
                Some(*value)
            }
            _ => None,
        })
    };
    let Some(variable) = loaded(function, condition) else {
        found.push((condition, true));
        return;
    };
    for (index, statement) in before.iter().enumerate() {
        if let Statement::If {
            condition,
            accept,
            reject,
        } = statement
            && let (Some(then), Some(otherwise)) =
                (stored(accept, variable), stored(reject, variable))
            && function.expressions[otherwise] == Expression::Literal(Literal::Bool(false))
        {
            conjuncts(function, *condition, &before[..index], found);
            found.push((then, true));
        }
    }
}

/// The bound with which a condition compares the counter, if stepping the counter eventually ends the loop.
fn bound_of(
    function: &Function,
    condition: Handle<Expression>,
    holds: bool,
    counter: Handle<LocalVariable>,
    step: LoopStep,
) -> Option<Handle<Expression>> {
    let Expression::Binary { op, left, right } = function.expressions[condition] else {
        return None;
    };
    let is_less = match op {
        BinaryOperator::Less | BinaryOperator::LessEqual => true,
        BinaryOperator::Greater | BinaryOperator::GreaterEqual => false,
        _ => return None,
    };
    let (is_less, bound) = if loaded(function, left) == Some(counter) {
        (is_less, right)
    } else if loaded(function, right) == Some(counter) {
        (!is_less, left)
    } else {
        return None;
    };
    let ends = match step {
        LoopStep::Up => is_less == holds,
        LoopStep::Down => is_less != holds,
    };
    ends.then_some(bound)
}

/// Collects the expressions that every round evaluates again; all others keep the values that they had before the loop.
fn evaluated_in(block: &Block, evaluated: &mut BTreeSet<usize>) {
    for statement in block.iter() {
        match statement {
            Statement::Emit(range) => evaluated.extend(range.clone().map(|e| e.index())),
            Statement::Call { result, .. } | Statement::Atomic { result, .. } => {
                evaluated.extend(result.map(|e| e.index()));
            }
            _ => {}
        }
        for child in children(statement) {
            evaluated_in(child, evaluated);
        }
    }
}

/// Returns true if a bound may change from round to round.
fn may_move(
    function: &Function,
    bound: Handle<Expression>,
    evaluated: &BTreeSet<usize>,
    stores: &[Handle<LocalVariable>],
) -> bool {
    let any = |parts: &[Option<Handle<Expression>>]| {
        parts
            .iter()
            .flatten()
            .any(|e| may_move(function, *e, evaluated, stores))
    };
    if !evaluated.contains(&bound.index()) {
        return false;
    }
    match function.expressions[bound] {
        Expression::Load { pointer } => {
            local(function, pointer).is_some_and(|v| stores.contains(&v))
        }
        Expression::Binary { left, right, .. } => any(&[Some(left), Some(right)]),
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => any(&[Some(expr)]),
        Expression::Access { base, index } => any(&[Some(base), Some(index)]),
        Expression::AccessIndex { base, .. } => any(&[Some(base)]),
        Expression::Math {
            arg, arg1, arg2, ..
        } => any(&[Some(arg), arg1, arg2]),
        Expression::ArrayLength(_) => false,
        // The result of any other computation in the loop, including a call, may change.
        _ => true,
    }
}
