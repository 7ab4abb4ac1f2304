//! Uniforms that are loaded once per invocation.
//!
//! Drivers that run shaders on a CPU load a uniform anew in every round of a loop that reads it. On Mesa's llvmpipe this took half of the
//! time of the pass that lists crossings. So a compute shader begins by copying into a private variable those members of its uniforms that
//! are addressed by constants alone, and compilers keep them in registers. Arrays with a computed index are not copied, because the copy
//! would need memory. Nor are members that nothing reads: compilers drop such copies, but only after they have compared each with every
//! other.
//!
//! Some files of the library imply that a table has one row ([`ONE_ROW`]): there the row is copied, whatever the index.
//!
//! Cost: a second validation by naga per composed shader. Only shaders with compute stages alone are changed: the others hardly loop.

use std::num::NonZeroU32;

use naga::proc::Layouter;
use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Arena, ArraySize, Block, Expression, Function, GlobalVariable, Handle, Module,
    Range, ShaderStage, Span, Statement, Type, TypeInner,
};

use super::join::undecorated;

/// Library files, and the arrays of which shaders with such a file read the first row alone: variable and member.
const ONE_ROW: &[(&str, &[[&str; 2]])] = &[
    (
        "lib/surfaces/one.wgsl",
        &[
            ["cut_table", "surfaces"],
            ["ray_table", "surfaces"],
            ["pyramid_table", "pyramids"],
        ],
    ),
    ("lib/rows/one.wgsl", &[["drawn_parts", "parts"]]),
];

/// Replaces the members of a compute shader's uniforms by private copies where no index into them is computed; `with` are the files that
/// fill open modules. Returns true if there was any.
pub(super) fn hold_uniforms(module: &mut Module, info: &ModuleInfo, with: &[&str]) -> bool {
    let stages = module.entry_points.iter().map(|e| e.stage);
    if !{ stages }.all(|stage| stage == ShaderStage::Compute) {
        return false;
    }
    let uniforms: Vec<Handle<GlobalVariable>> = (module.global_variables.iter())
        .filter(|(_, variable)| variable.space == AddressSpace::Uniform)
        .map(|(handle, _)| handle)
        .collect();
    let one_row: Vec<[&str; 2]> = (ONE_ROW.iter())
        .filter(|(file, _)| with.contains(file))
        .flat_map(|(_, arrays)| arrays.iter().copied())
        .collect();
    uniforms.into_iter().fold(false, |any, uniform| {
        let members = members_of(module, uniform, &one_row);
        hold(module, info, uniform, &members) || any
    })
}

/// A member of a uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Member {
    /// All indices into it are constants.
    Constant,
    /// An array with one row.
    OneRow,
    /// An index into it is computed.
    Indexed,
    /// No function addresses it.
    Unread,
}

impl Member {
    fn is_held(self) -> bool {
        matches!(self, Self::Constant | Self::OneRow)
    }
}

/// The members of a uniform's struct; none if it is no struct.
fn members_of(
    module: &Module,
    uniform: Handle<GlobalVariable>,
    one_row: &[[&str; 2]],
) -> Vec<Member> {
    let variable = &module.global_variables[uniform];
    let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
        return Vec::new();
    };
    let variable = undecorated(variable.name.as_deref().unwrap_or_default());
    let has_one_row = |member: &naga::StructMember| {
        let member = member.name.as_deref().unwrap_or_default();
        one_row.contains(&[variable, member])
    };
    let read: Vec<u32> = read_members(module, uniform).collect();
    let mut found: Vec<Member> = ((0..).zip(members))
        .map(|(index, member)| match has_one_row(member) {
            _ if !read.contains(&index) => Member::Unread,
            true => Member::OneRow,
            false => Member::Constant,
        })
        .collect();
    for function in functions(module) {
        for (_, expression) in function.expressions.iter() {
            let Expression::Access { base, .. } = *expression else {
                continue;
            };
            // An index into the member itself, not into one of its rows.
            let is_row = matches!(&function.expressions[base],
                Expression::AccessIndex { base, .. } if is_mention(&function.expressions, *base, uniform));
            if let Some(member) = member_behind(function, base, uniform)
                && !(is_row && found[member] == Member::OneRow)
            {
                found[member] = Member::Indexed;
            }
        }
    }
    found
}

/// Indices of the members of a uniform that functions address, each as often as they do.
fn read_members(module: &Module, uniform: Handle<GlobalVariable>) -> impl Iterator<Item = u32> {
    functions(module).flat_map(move |function| {
        let expressions = &function.expressions;
        expressions.iter().filter_map(move |(_, e)| match *e {
            Expression::AccessIndex { base, index } if is_mention(expressions, base, uniform) => {
                Some(index)
            }
            _ => None,
        })
    })
}

fn functions(module: &Module) -> impl Iterator<Item = &Function> {
    let others = module.functions.iter().map(|(_, function)| function);
    (module.entry_points.iter().map(|e| &e.function)).chain(others)
}

fn is_mention(
    expressions: &Arena<Expression>,
    expression: Handle<Expression>,
    variable: Handle<GlobalVariable>,
) -> bool {
    matches!(expressions[expression], Expression::GlobalVariable(found) if found == variable)
}

/// The member of a uniform that a pointer leads into.
fn member_behind(
    function: &Function,
    mut pointer: Handle<Expression>,
    uniform: Handle<GlobalVariable>,
) -> Option<usize> {
    loop {
        match function.expressions[pointer] {
            Expression::Access { base, .. } => pointer = base,
            Expression::AccessIndex { base, index } => {
                if is_mention(&function.expressions, base, uniform) {
                    return Some(index as usize);
                }
                pointer = base;
            }
            _ => return None,
        }
    }
}

/// Adds a private copy of a uniform, has functions read its members there, and fills these at the start of the entry points that use the
/// uniform. Returns true if any member is held.
fn hold(
    module: &mut Module,
    info: &ModuleInfo,
    uniform: Handle<GlobalVariable>,
    members: &[Member],
) -> bool {
    let Some(ty) = held_type(module, uniform, members) else {
        return false;
    };
    let original = &module.global_variables[uniform];
    let private = GlobalVariable {
        name: original.name.as_ref().map(|name| format!("held_{name}")),
        space: AddressSpace::Private,
        binding: None,
        ty,
        ..original.clone()
    };
    let span = module.global_variables.get_span(uniform);
    let private = module.global_variables.append(private, span);
    let others = module.functions.iter_mut().map(|(_, function)| function);
    for function in (module.entry_points.iter_mut().map(|e| &mut e.function)).chain(others) {
        read_copies(&mut function.expressions, uniform, private, members);
    }
    for (index, entry) in module.entry_points.iter_mut().enumerate() {
        if !info.get_entry_point(index)[uniform].is_empty() {
            fill(&mut entry.function, uniform, private, members);
        }
    }
    true
}

/// A struct of the held members of a uniform, arrays with one row as long as that; `None` if no member is held.
fn held_type(
    module: &mut Module,
    uniform: Handle<GlobalVariable>,
    members: &[Member],
) -> Option<Handle<Type>> {
    let whole = module.types[module.global_variables[uniform].ty].clone();
    let TypeInner::Struct {
        members: fields, ..
    } = whole.inner
    else {
        return None;
    };
    let mut held = Vec::new();
    for (mut field, member) in fields.into_iter().zip(members) {
        if !member.is_held() {
            continue;
        }
        if *member == Member::OneRow
            && let TypeInner::Array { base, stride, .. } = module.types[field.ty].inner
        {
            let size = ArraySize::Constant(NonZeroU32::MIN);
            let inner = TypeInner::Array { base, size, stride };
            field.ty = module
                .types
                .insert(Type { name: None, inner }, Span::UNDEFINED);
        }
        held.push(field);
    }
    let mut layouts = Layouter::default();
    layouts.update(module.to_ctx()).ok()?;
    let mut span = 0;
    for field in &mut held {
        let layout = layouts[field.ty];
        field.offset = layout.alignment.round_up(span);
        span = field.offset + layout.size;
    }
    let alignment = held.iter().map(|field| layouts[field.ty].alignment).max()?;
    let inner = TypeInner::Struct {
        members: held,
        span: alignment.round_up(span),
    };
    let name = whole.name.map(|name| format!("Held{name}"));
    Some(module.types.insert(Type { name, inner }, Span::UNDEFINED))
}

/// Position of a held member among those that are held.
fn place_of(members: &[Member], index: u32) -> u32 {
    let before = &members[..index as usize];
    before.iter().filter(|m| m.is_held()).count() as u32
}

/// Replaces the mentions of a uniform that lead into held members alone.
fn read_copies(
    expressions: &mut Arena<Expression>,
    uniform: Handle<GlobalVariable>,
    private: Handle<GlobalVariable>,
    members: &[Member],
) {
    let mentions: Vec<Handle<Expression>> = (expressions.iter())
        .filter(|(_, e)| matches!(e, Expression::GlobalVariable(found) if *found == uniform))
        .map(|(handle, _)| handle)
        .collect();
    for mention in mentions {
        let is_left = expressions.iter().any(|(_, e)| match *e {
            Expression::AccessIndex { base, index } if base == mention => {
                !members[index as usize].is_held()
            }
            // The struct as a whole.
            Expression::Load { pointer } => pointer == mention,
            _ => false,
        });
        if is_left {
            continue;
        }
        expressions[mention] = Expression::GlobalVariable(private);
        for (_, e) in expressions.iter_mut() {
            match e {
                Expression::AccessIndex { base, index } if *base == mention => {
                    *index = place_of(members, *index);
                }
                _ => {}
            }
        }
    }
    // The only index into a held member that is computed is that of a single row.
    let is_row = |array: Handle<Expression>| {
        matches!(expressions[array],
        Expression::AccessIndex { base, .. } if is_mention(expressions, base, private))
    };
    let rows: Vec<Handle<Expression>> = (expressions.iter())
        .filter(|(_, e)| matches!(e, Expression::Access { base, .. } if is_row(*base)))
        .map(|(handle, _)| handle)
        .collect();
    for row in rows {
        if let Expression::Access { base, .. } = expressions[row] {
            expressions[row] = Expression::AccessIndex { base, index: 0 };
        }
    }
}

/// Copies the held members at the start of an entry point.
fn fill(
    function: &mut Function,
    uniform: Handle<GlobalVariable>,
    private: Handle<GlobalVariable>,
    members: &[Member],
) {
    let mut start = Block::new();
    for (index, member) in members.iter().enumerate() {
        if !member.is_held() {
            continue;
        }
        let index = index as u32;
        let [copy, original] = [private, uniform].map(|variable| {
            let mention = Expression::GlobalVariable(variable);
            function.expressions.append(mention, Span::UNDEFINED)
        });
        let mut added = Vec::new();
        let mut add = |expression| {
            let handle = function.expressions.append(expression, Span::UNDEFINED);
            added.push(handle);
            handle
        };
        let mut member_of = |base, index| {
            let base = add(Expression::AccessIndex { base, index });
            match member {
                Member::OneRow => add(Expression::AccessIndex { base, index: 0 }),
                _ => base,
            }
        };
        let pointer = member_of(copy, place_of(members, index));
        let from = member_of(original, index);
        let value = add(Expression::Load { pointer: from });
        let emitted = Range::new_from_bounds(added[0], value);
        start.push(Statement::Emit(emitted), Span::UNDEFINED);
        start.push(Statement::Store { pointer, value }, Span::UNDEFINED);
    }
    function.body.splice(0..0, start);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::compose_text_with;

    const TABLE: &str = "struct Row { x: vec2<u32>, y: u32, z: u32 }\n\
        struct Table { count: u32, few: array<vec4<u32>, 2>, surfaces: array<Row, 64> }\n\
        @group(0) @binding(0) var<uniform> cut_table: Table;\n\
        @group(0) @binding(1) var<storage, read_write> out: array<u32>;\n\
        fn row_of(i: u32) -> u32 { return cut_table.surfaces[i].y; }\n\
        @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {\n\
            out[id.x] = cut_table.count + cut_table.few[1].z + row_of(id.y);\n\
        }\n\
        @compute @workgroup_size(1) fn idle() { out[0] = 1u; }\n";

    /// Names of the members that a module holds.
    fn held(module: &Module) -> Vec<&str> {
        let private = module.global_variables.iter();
        let mut private = private.filter(|(_, v)| v.space == AddressSpace::Private);
        let Some((_, variable)) = private.next() else {
            return Vec::new();
        };
        let TypeInner::Struct { members, .. } = &module.types[variable.ty].inner else {
            panic!("no struct");
        };
        members.iter().filter_map(|m| m.name.as_deref()).collect()
    }

    #[test]
    fn members_with_constant_indices_are_copied_where_they_are_used() {
        let module = compose_text_with("planted", TABLE, &[]).expect("valid");
        assert_eq!(held(&module), ["count", "few"]);
        let stores = |entry: usize| {
            let body = module.entry_points[entry].function.body.iter();
            { body }
                .filter(|s| matches!(s, Statement::Store { .. }))
                .count()
        };
        assert_eq!([stores(0), stores(1)], [2 + 1, 1]);
        // A member that nothing reads, an index that is computed, and a stage that is not compute.
        let unread = TABLE.replace(" + cut_table.few[1].z", "");
        let module = compose_text_with("planted", &unread, &[]).expect("valid");
        assert_eq!(held(&module), ["count"]);
        let indexed = TABLE.replace("few[1]", "few[id.z % 2u]");
        let module = compose_text_with("planted", &indexed, &[]).expect("valid");
        assert_eq!(held(&module), ["count"]);
        let fragment = "struct Table { count: u32 }\n\
            @group(0) @binding(0) var<uniform> table: Table;\n\
            @fragment fn main() -> @location(0) u32 { return table.count; }";
        let module = compose_text_with("planted", fragment, &[]).expect("valid");
        assert!(held(&module).is_empty());
    }

    #[test]
    fn an_array_with_one_row_is_held_as_that_row() {
        let mut module = naga::front::wgsl::parse_str(TABLE).expect("valid");
        let info = crate::shader::validate(&module).expect("valid");
        assert!(hold_uniforms(
            &mut module,
            &info,
            &["lib/surfaces/one.wgsl"]
        ));
        crate::shader::validate(&module).expect("still valid");
        assert_eq!(held(&module), ["count", "few", "surfaces"]);
        let is_indexed = |f: &Function| {
            (f.expressions.iter()).any(|(_, e)| matches!(e, Expression::Access { .. }))
        };
        assert!(!module.functions.iter().any(|(_, f)| is_indexed(f)));
    }
}
