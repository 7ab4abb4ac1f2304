//! Converts scene values to Python objects and back: numbers, texts, lists and tables.

use std::sync::Arc;

use cutaway_io::document::paths::{self, Path};
use cutaway_io::document::{Node, Value};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};

/// Deepest nesting of lists and tables. No scene value comes near this limit; it stops the conversion of cyclic objects.
const DEEPEST: usize = 16;

/// Converts a Python object to a value: `bool`, `int`, `float`, `str`, paths, lists, tuples, arrays and `dict`.
pub(crate) fn value(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    value_within(object, DEEPEST)
}

fn value_within(object: &Bound<'_, PyAny>, room: usize) -> PyResult<Value> {
    let Some(room) = room.checked_sub(1) else {
        return Err(refused(object, "it has lists in lists without end"));
    };
    if let Ok(flag) = object.cast::<PyBool>() {
        return Ok(flag.is_true().into());
    }
    if object.is_instance_of::<PyInt>() {
        let whole = object.extract::<i64>();
        let whole = whole.map_err(|_| refused(object, "it is a whole number beyond 64 bits"))?;
        return Ok(whole.into());
    }
    if object.is_instance_of::<PyFloat>() {
        let number: f64 = object.extract()?;
        return match number.is_finite() {
            true => Ok(number.into()),
            false => Err(refused(object, "it is not finite")),
        };
    }
    if object.is_instance_of::<PyString>() {
        return Ok(text_of(object)?.into());
    }
    if let Ok(table) = object.cast::<PyDict>() {
        let entry = |(key, held): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            let key: Arc<str> = text_of(&key)?.into();
            Ok((key, Node::new(value_within(&held, room)?)))
        };
        return Ok(Value::Table(
            table.iter().map(entry).collect::<PyResult<_>>()?,
        ));
    }
    if object.hasattr("__fspath__")? {
        return value_within(&object.call_method0("__fspath__")?, room);
    }
    // Arrays, and numpy scalars.
    if object.hasattr("tolist")? {
        return value_within(&object.call_method0("tolist")?, room);
    }
    // Objects without a length may be endless iterators.
    let (Ok(_), Ok(items)) = (object.len(), object.try_iter()) else {
        return Err(refused(object, "it is no value of a scene"));
    };
    let node = |item: PyResult<Bound<'_, PyAny>>| Ok(Node::new(value_within(&item?, room)?));
    Ok(Value::List(items.map(node).collect::<PyResult<_>>()?))
}

/// A text without unpaired surrogates, because no file could contain them.
fn text_of(object: &Bound<'_, PyAny>) -> PyResult<String> {
    let text = object.extract::<String>();
    text.map_err(|_| refused(object, "it is no text in Unicode"))
}

fn refused(object: &Bound<'_, PyAny>, what: &str) -> PyErr {
    let kind = object.get_type();
    let kind = kind.name().map(|name| name.to_string());
    let kind = kind.unwrap_or_else(|_| "an object".to_owned());
    PyValueError::new_err(format!(
        "value of type {kind}: {what}\n  help: give a bool, int, float or str, or lists and dicts of them"
    ))
}

/// Declarations of all values of a scene: `path`, `takes`, `unit`, `help`, `example`, `moves`, and, for values with limits, `range`: the
/// minimum and the maximum.
#[pyfunction]
pub(crate) fn values(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let one = |path: &Path| {
        let about = PyDict::new(py);
        about.set_item("path", &path.path)?;
        about.set_item("takes", path.takes.to_string())?;
        about.set_item("unit", path.unit)?;
        about.set_item("help", path.help)?;
        about.set_item("example", path.example)?;
        about.set_item("moves", path.moves)?;
        about.set_item("range", path.takes.range())?;
        Ok(about)
    };
    paths::all().iter().map(one).collect()
}

/// A value as a Python object.
pub(crate) fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Flag(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Number(number) => match number.whole {
            Some(whole) => whole.into_pyobject(py)?.into_any(),
            None => number.value.into_pyobject(py)?.into_any(),
        },
        Value::Text(text) | Value::Date(text) => PyString::new(py, text).into_any(),
        Value::List(items) => {
            let items = items.iter().map(|node| object(py, &node.value));
            PyList::new(py, items.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Table(entries) => {
            let table = PyDict::new(py);
            for (key, node) in entries {
                table.set_item(&**key, object(py, &node.value)?)?;
            }
            table.into_any()
        }
    })
}
