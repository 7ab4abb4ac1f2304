//! Checks that constants limit the bound of a loop, so that its number of rounds cannot grow with the mesh or the picture.
//!
//! Drivers end loops that run long: llvmpipe after 65,535 rounds of all loops of an invocation together, cards by a watchdog. So a bound
//! from data must be limited by a constant: `min(count, MOST)`. So must an override, which a plan sets: one once allowed 2^24 rounds.
//! The analysis follows literals, constants, arithmetic on them, `min` and `clamp`, masks, shifts and remainders, local variables through
//! all stores to them, arguments through all calls, and results of the shader's functions. All other values, in particular words of
//! buffers, count as unbounded.
//!
//! Limits: the rounds of nested loops are not multiplied.

use super::loops::{children, loaded, local};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, MathFunction,
    Module, ScalarKind, Statement,
};

/// Maximum nesting depth of expressions that is followed.
const DEEPEST: u32 = 32;

/// A function, with the module that contains it and the functions that it calls.
#[derive(Clone, Copy)]
pub(super) struct FunctionPlace<'a> {
    pub module: &'a Module,
    pub function: &'a Function,
}

impl FunctionPlace<'_> {
    /// Returns true if an integer expression has a constant upper bound, whatever the buffers contain.
    pub(super) fn is_limited(self, expression: Handle<Expression>) -> bool {
        self.limited(expression, 0)
    }

    /// Returns true if a counter begins at or above a constant, or is unsigned.
    pub(super) fn begins_high(self, counter: Handle<LocalVariable>, inside: &Block) -> bool {
        self.counts_unsigned(counter)
            || self.begins(counter, inside, |place, e| place.is_high(e, 0))
    }

    /// Returns true if a counter begins at or below a constant.
    pub(super) fn begins_low(self, counter: Handle<LocalVariable>, inside: &Block) -> bool {
        self.begins(counter, inside, |place, e| place.limited(e, 0))
    }

    /// Returns true if every value stored to a counter outside its loop satisfies `is_wanted`.
    fn begins(
        self,
        counter: Handle<LocalVariable>,
        inside: &Block,
        is_wanted: impl Fn(Self, Handle<Expression>) -> bool,
    ) -> bool {
        let mut all = Vec::new();
        stored(self.function, &self.function.body, counter, &mut all);
        let mut own = Vec::new();
        stored(self.function, inside, counter, &mut own);
        all.iter()
            .filter(|value| !own.contains(value))
            .all(|value| is_wanted(self, *value))
    }

    fn limited(self, expression: Handle<Expression>, depth: u32) -> bool {
        if depth > DEEPEST {
            return false;
        }
        let limited = |e| self.limited(e, depth + 1);
        match self.function.expressions[expression] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => true,
            Expression::Compose { ref components, .. } => components.iter().all(|c| limited(*c)),
            Expression::Splat { value, .. } => limited(value),
            Expression::Swizzle { vector, .. } => limited(vector),
            Expression::As { expr, .. } => limited(expr),
            Expression::AccessIndex { base, index } => self.member_is_limited(base, index, depth),
            Expression::Select { accept, reject, .. } => limited(accept) && limited(reject),
            Expression::Binary { op, left, right } => match op {
                BinaryOperator::Add | BinaryOperator::Multiply | BinaryOperator::ShiftLeft => {
                    limited(left) && limited(right)
                }
                BinaryOperator::Subtract => {
                    limited(left) && (self.is_unsigned(right) || self.is_high(right, depth + 1))
                }
                BinaryOperator::Divide | BinaryOperator::ShiftRight => limited(left),
                BinaryOperator::Modulo => limited(right),
                BinaryOperator::And => limited(left) || limited(right),
                _ => false,
            },
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => match fun {
                MathFunction::Min => limited(arg) || arg1.is_some_and(limited),
                MathFunction::Max => limited(arg) && arg1.is_some_and(limited),
                MathFunction::Clamp => arg2.is_some_and(limited),
                MathFunction::Floor | MathFunction::Ceil | MathFunction::Round => limited(arg),
                MathFunction::FirstLeadingBit
                | MathFunction::FirstTrailingBit
                | MathFunction::CountOneBits
                | MathFunction::CountTrailingZeros
                | MathFunction::CountLeadingZeros => true,
                _ => false,
            },
            Expression::Load { pointer } => match self.function.expressions[pointer] {
                Expression::LocalVariable(variable) => {
                    let mut values = Vec::new();
                    stored(self.function, &self.function.body, variable, &mut values);
                    !values.is_empty() && values.iter().all(|v| limited(*v))
                }
                _ => false,
            },
            Expression::FunctionArgument(index) => self.argument_is_limited(index, depth),
            Expression::CallResult(function) => self
                .results(function)
                .all(|(within, value)| within.limited(value, depth + 1)),
            _ => false,
        }
    }

    /// Expressions that a function may return, each with the function in which to evaluate it.
    fn results(
        self,
        function: Handle<Function>,
    ) -> impl Iterator<Item = (Self, Handle<Expression>)> {
        let function = &self.module.functions[function];
        let mut values = Vec::new();
        returned(&function.body, &mut values);
        let within = FunctionPlace { function, ..self };
        values.into_iter().map(move |value| (within, value))
    }

    /// Returns true if a member of a struct or a component of a vector has a constant upper bound.
    fn member_is_limited(self, base: Handle<Expression>, index: u32, depth: u32) -> bool {
        match &self.function.expressions[base] {
            Expression::Compose { components, .. } => (components.get(index as usize))
                .is_some_and(|component| self.limited(*component, depth + 1)),
            Expression::CallResult(function) => (self.results(*function))
                .all(|(within, value)| within.member_is_limited(value, index, depth + 1)),
            _ => self.limited(base, depth + 1),
        }
    }

    /// Returns true if the argument has a constant upper bound in every call of the function.
    fn argument_is_limited(self, index: u32, depth: u32) -> bool {
        let mut named = self.module.functions.iter();
        let Some((own, _)) = named.find(|(_, f)| std::ptr::eq(*f, self.function)) else {
            return false;
        };
        let functions = self.module.functions.iter().map(|(_, f)| f);
        let all = functions.chain(self.module.entry_points.iter().map(|e| &e.function));
        let mut is_called = false;
        for function in all {
            let mut given = Vec::new();
            arguments_in(&function.body, own, index, &mut given);
            is_called |= !given.is_empty();
            let caller = FunctionPlace { function, ..self };
            if !given.iter().all(|e| caller.limited(*e, depth + 1)) {
                return false;
            }
        }
        is_called
    }

    /// Returns true if a local variable begins at or above a constant and is only incremented.
    fn only_rises(self, pointer: Handle<Expression>, depth: u32) -> bool {
        let Expression::LocalVariable(variable) = self.function.expressions[pointer] else {
            return false;
        };
        let is_step_up = |value: Handle<Expression>| {
            let Expression::Binary { op, left, right } = self.function.expressions[value] else {
                return false;
            };
            let by = match self.function.expressions[right] {
                Expression::Literal(Literal::I32(n)) => n,
                _ => -1,
            };
            let is_own = loaded(self.function, left) == Some(variable);
            op == BinaryOperator::Add && by >= 0 && is_own
        };
        let mut values = Vec::new();
        stored(self.function, &self.function.body, variable, &mut values);
        (values.iter()).all(|value| is_step_up(*value) || self.is_high(*value, depth))
    }

    fn counts_unsigned(self, variable: Handle<LocalVariable>) -> bool {
        let ty = self.function.local_variables[variable].ty;
        let scalar = self.module.types[ty].inner.scalar();
        scalar.is_some_and(|s| s.kind == ScalarKind::Uint)
    }

    fn is_unsigned(self, expression: Handle<Expression>) -> bool {
        match self.function.expressions[expression] {
            Expression::Literal(literal) => matches!(literal, Literal::U32(_)),
            Expression::As { kind, .. } => kind == ScalarKind::Uint,
            Expression::Binary { left, right, .. } => {
                self.is_unsigned(left) || self.is_unsigned(right)
            }
            Expression::Load { pointer } => match self.function.expressions[pointer] {
                Expression::LocalVariable(variable) => self.counts_unsigned(variable),
                _ => false,
            },
            _ => false,
        }
    }

    /// Returns true if a signed expression has a constant lower bound.
    fn is_high(self, expression: Handle<Expression>, depth: u32) -> bool {
        if depth > DEEPEST {
            return false;
        }
        let high = |e| self.is_high(e, depth + 1);
        match self.function.expressions[expression] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => true,
            Expression::Unary { expr, .. } => self.limited(expr, depth + 1),
            Expression::As { kind, expr, .. } => {
                kind == ScalarKind::Uint || high(expr) || self.is_unsigned(expr)
            }
            Expression::Binary { op, left, right } => match op {
                BinaryOperator::Add | BinaryOperator::Multiply => high(left) && high(right),
                BinaryOperator::Subtract => high(left) && self.limited(right, depth + 1),
                BinaryOperator::Divide | BinaryOperator::ShiftRight => high(left),
                _ => false,
            },
            Expression::Math { fun, arg, arg1, .. } => match fun {
                MathFunction::Max => high(arg) || arg1.is_some_and(high),
                MathFunction::Min => high(arg) && arg1.is_some_and(high),
                MathFunction::Clamp => arg1.is_some_and(high),
                MathFunction::Abs => true,
                _ => false,
            },
            Expression::Load { pointer } => {
                self.is_unsigned(expression) || self.only_rises(pointer, depth + 1)
            }
            Expression::FunctionArgument(_) => false,
            _ => self.is_unsigned(expression),
        }
    }
}

/// Values stored to a variable in a block; a store to a member counts as a store to the whole variable.
fn stored(
    function: &Function,
    block: &Block,
    variable: Handle<LocalVariable>,
    values: &mut Vec<Handle<Expression>>,
) {
    for statement in block.iter() {
        if let Statement::Store { pointer, value } = statement
            && local(function, *pointer) == Some(variable)
        {
            values.push(*value);
        }
        for child in children(statement) {
            stored(function, child, variable, values);
        }
    }
}

fn returned(block: &Block, values: &mut Vec<Handle<Expression>>) {
    for statement in block.iter() {
        if let Statement::Return { value } = statement {
            values.extend(value);
        }
        for child in children(statement) {
            returned(child, values);
        }
    }
}

fn arguments_in(
    block: &Block,
    of: Handle<Function>,
    index: u32,
    given: &mut Vec<Handle<Expression>>,
) {
    for statement in block.iter() {
        if let Statement::Call {
            function,
            arguments,
            ..
        } = statement
            && *function == of
        {
            given.extend(arguments.get(index as usize));
        }
        for child in children(statement) {
            arguments_in(child, of, index, given);
        }
    }
}
