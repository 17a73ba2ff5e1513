//! Reads the arguments of Python, and refuses what is not allowed.

use impact_chain::{Chain, Error, ErrorKind};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use serde_json::{Map, Value, from_str, from_value, to_value};
use std::fmt::Display;

pub fn to_python(error: Error) -> PyErr {
    match error.kind() {
        ErrorKind::Work => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Reads the value of a keyword, arrays of numpy included.
pub fn json_value(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    let py = value.py();
    let tolist = py.import("operator")?.call_method1("methodcaller", ("tolist",))?;
    let arguments = [("default", tolist)].into_py_dict(py)?;
    arguments.set_item("allow_nan", false)?;
    let json = py.import("json")?.call_method("dumps", (value,), Some(&arguments));
    let json = json.map_err(|error| {
        if error.is_instance_of::<PyValueError>(py) {
            PyValueError::new_err(format!("{name}: a number is not finite; give finite numbers"))
        } else {
            let message = format!("{name}: {}; give numbers or arrays of them", error.value(py));
            PyTypeError::new_err(message)
        }
    })?;
    from_str(json.extract()?).map_err(|error| refused(name, error))
}

pub fn json_values(fields: Option<&Bound<'_, PyDict>>) -> PyResult<Map<String, Value>> {
    let mut values = Map::new();
    for (name, value) in fields.into_iter().flatten() {
        let name: String = name.extract()?;
        let value = json_value(&name, &value)?;
        values.insert(name, value);
    }
    Ok(values)
}

pub fn refused(name: &str, problem: impl Display) -> PyErr {
    PyValueError::new_err(format!("{name}: {problem}"))
}

/// Reads a chain from keywords: the fields of `Chain`, of which `start` is `initial` here.
pub fn chain_from(fields: Option<&Bound<'_, PyDict>>) -> PyResult<Chain> {
    let mut chain = Chain::default();
    for (name, value) in json_values(fields)? {
        let mut fields = to_value(&chain).map_err(|error| refused(&name, error))?;
        let known = match name.as_str() {
            "start" => None,
            "initial" => fields.get_mut("start"),
            name => fields.get_mut(name),
        };
        let Some(field) = known else {
            let names = "masses, spacing, natural_frequency, forcing_frequency, restitution, \
                         boundary, initial";
            return Err(refused(&name, format!("give one of {names}")));
        };
        *field = value;
        chain = from_value(fields).map_err(|error| refused(&name, error))?;
    }
    Ok(chain)
}

pub fn whole_number(name: &str, value: i128) -> PyResult<u64> {
    let remedy = "give a whole number from 0 to 2**64 - 1";
    u64::try_from(value).map_err(|_| refused(name, format!("{value}; {remedy}")))
}
