//! Checks our own WGSL rules on naga's representation of a composed shader.
//!
//! naga checks that a shader is valid. The rules here require that every loop ends, no decision depends on the equality of two
//! floats, every declaration is used, and core WebGPU can run the shader. A finding names its rule and its place. The tests of
//! the tree list the findings that are allowed, with reasons.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{BinaryOperator, Expression, Function, Handle, Module, Scalar, ScalarKind, ShaderStage};

use super::bounds::FunctionPlace;
use super::compose::validate;
use super::join::undecorated;
use super::loops::{End, ends_of_loops};
use super::reflect::{BindingKind, bindings};
use crate::{Error, Result};

/// A rule that shaders must follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// A loop counts towards a bound that the loop does not change.
    BoundedLoops,
    /// A constant limits the rounds of a loop, because drivers end loops that run long.
    ConstantBounds,
    /// Floats are compared by order, never by equality.
    FloatEquality,
    /// A binding that a shader declares is used by one of its entry points.
    UsedBindings,
    /// A stage sees at most 8 storage buffers.
    StorageBuffers,
    /// A workgroup has at most 256 invocations.
    Workgroup,
    /// Either one compute entry point `main`, or `vertex` and `fragment`.
    EntryPoints,
}

/// Place where a shader breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    pub rule: Rule,
    /// Name of the function, variable or stage in the source.
    pub place: String,
    /// Description of the violation.
    pub what: String,
}

/// Maximum number of storage buffers per stage in core WebGPU. Plans are also checked against this limit.
pub const STORAGE_BUFFERS_PER_STAGE: usize = 8;
/// Maximum number of invocations per workgroup in core WebGPU.
pub const INVOCATIONS_PER_WORKGROUP: u32 = 256;

/// All rule violations in a composed shader.
pub fn lint(module: &Module) -> Result<Vec<Finding>> {
    let info = validate(module).map_err(|what| Error::Shader {
        name: "lint".to_owned(),
        what,
    })?;
    let mut found = Vec::new();
    for (handle, function) in module.functions.iter() {
        let name = undecorated(function.name.as_deref().unwrap_or_default());
        in_function(module, function, &info[handle], name, &mut found);
    }
    for (index, entry) in module.entry_points.iter().enumerate() {
        let info = info.get_entry_point(index);
        in_function(module, &entry.function, info, &entry.name, &mut found);
    }
    unused_bindings(module, &info, &mut found);
    of_stages(module, &info, &mut found);
    Ok(found)
}

fn in_function(
    module: &Module,
    function: &Function,
    info: &FunctionInfo,
    name: &str,
    found: &mut Vec<Finding>,
) {
    for (number, end) in ends_of_loops(FunctionPlace { module, function })
        .iter()
        .enumerate()
    {
        let (rule, what) = match end {
            End::ByConstant => continue,
            End::Unproven => (
                Rule::BoundedLoops,
                "has no counter that is compared with a bound and stepped towards it",
            ),
            End::ByData => (
                Rule::ConstantBounds,
                "has a number of rounds that depends on data: limit the bound by a constant",
            ),
        };
        let place = name.to_owned();
        let what = format!("loop {} {what}", number + 1);
        found.push(Finding { rule, place, what });
    }
    let is_float = |e: Handle<Expression>| {
        let scalar: Option<Scalar> = info[e].ty.inner_with(&module.types).scalar();
        scalar.is_some_and(|s| s.kind == ScalarKind::Float)
    };
    for (_, expression) in function.expressions.iter() {
        if let Expression::Binary { op, left, right } = *expression
            && matches!(op, BinaryOperator::Equal | BinaryOperator::NotEqual)
            && (is_float(left) || is_float(right))
        {
            found.push(Finding {
                rule: Rule::FloatEquality,
                place: name.to_owned(),
                what: "two floats are compared for equality".to_owned(),
            });
        }
    }
}

/// Reports unused bindings that the shader's own file declares. Library bindings may be unused, because other importers need them.
fn unused_bindings(module: &Module, info: &ModuleInfo, found: &mut Vec<Finding>) {
    for (handle, variable) in module.global_variables.iter() {
        let name = variable.name.as_deref().unwrap_or_default();
        let is_used = (0..module.entry_points.len())
            .any(|index| !info.get_entry_point(index)[handle].is_empty());
        if variable.binding.is_some() && !is_used && undecorated(name) == name {
            found.push(Finding {
                rule: Rule::UsedBindings,
                place: name.to_owned(),
                what: "a binding that no entry point uses".to_owned(),
            });
        }
    }
}

fn of_stages(module: &Module, info: &ModuleInfo, found: &mut Vec<Finding>) {
    let bound = bindings(module, info);
    for (stage, name) in ["vertex", "fragment", "compute"].into_iter().enumerate() {
        let is_storage = |kind| {
            matches!(
                kind,
                BindingKind::StorageRead | BindingKind::StorageReadWrite
            )
        };
        let count = bound
            .iter()
            .filter(|b| is_storage(b.kind) && b.stages[stage])
            .count();
        if count > STORAGE_BUFFERS_PER_STAGE {
            found.push(Finding {
                rule: Rule::StorageBuffers,
                place: name.to_owned(),
                what: format!("{count} storage buffers"),
            });
        }
    }
    for entry in &module.entry_points {
        let invocations: u32 = entry.workgroup_size.iter().product();
        if entry.stage == ShaderStage::Compute && invocations > INVOCATIONS_PER_WORKGROUP {
            found.push(Finding {
                rule: Rule::Workgroup,
                place: entry.name.clone(),
                what: format!("{invocations} invocations in a workgroup"),
            });
        }
    }
    let mut entries: Vec<(ShaderStage, &str)> = module
        .entry_points
        .iter()
        .map(|e| (e.stage, e.name.as_str()))
        .collect();
    entries.sort_unstable_by_key(|(_, name)| *name);
    let compute = [(ShaderStage::Compute, "main")];
    let draw = [
        (ShaderStage::Fragment, "fragment"),
        (ShaderStage::Vertex, "vertex"),
    ];
    if entries != compute && entries != draw {
        found.push(Finding {
            rule: Rule::EntryPoints,
            place: "entry points".to_owned(),
            what: format!("{entries:?}"),
        });
    }
}
