//! Offers the engine to Python, as arrays. Keywords become JSON in `python/impact_chain`.

mod ensemble;

use impact_chain::{
    Chain, Engine, Error, Event, LATEST, NormalPairs, Seed, Start, State, check_range,
};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::ops::ControlFlow::{Break, Continue};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

type Array<'py, T = f64> = Bound<'py, PyArray1<T>>;
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

fn to_python(error: Error) -> PyErr {
    match error {
        Error::Work { .. } => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Computes without the lock of Python, which sees Ctrl-C all the while: `compute` then finds the
/// flag set, and what it returns is dropped.
fn compute_detached<T: Send>(
    py: Python<'_>,
    compute: impl FnOnce(&AtomicBool) -> Result<T, Error> + Send,
) -> PyResult<T> {
    let stop = &AtomicBool::new(false);
    py.detach(|| {
        std::thread::scope(|scope| {
            let (sender, receiver) = channel();
            scope.spawn(move || sender.send(compute(stop)));
            loop {
                match receiver.recv_timeout(Duration::from_millis(50)) {
                    Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())
                        .inspect_err(|_| stop.store(true, Relaxed))?,
                    result => return result.expect("a result").map_err(to_python),
                }
            }
        })
    })
}

/// What the class of the same name in Python is made of.
#[pyclass(frozen, eq, subclass, module = "impact_chain._engine")]
#[derive(Clone, PartialEq)]
struct Scenario(impact_chain::Scenario);

#[pymethods]
impl Scenario {
    #[new]
    fn new(scenario: &Scenario) -> Scenario {
        scenario.clone()
    }

    /// Writes the scenario as JSON in one line.
    fn to_json(&self) -> String {
        self.0.to_json()
    }
}

#[pyfunction]
fn from_json(text: &str) -> PyResult<Scenario> {
    impact_chain::Scenario::from_json(text).map(Scenario).map_err(to_python)
}

/// Replaces the forcing of a scenario by normals, and a random start too.
#[pyfunction]
fn draw(
    text: &str,
    sigma: f64,
    index: u64,
    is_random_start: bool,
    stream: &str,
    seed: u64,
) -> PyResult<Scenario> {
    check_range("sigma", sigma, 0.0, 1e9).map_err(to_python)?;
    let mut scenario = impact_chain::Scenario::parse_json(text).map_err(to_python)?;
    let start = if is_random_start { Start::Random } else { Start::Zero };
    let chain = Chain { masses: scenario.forcing.len(), start, ..Chain::default() };
    let mut normals = NormalPairs::new(stream, Seed(seed), index);
    let drawn = impact_chain::Scenario::draw(&chain, sigma, &mut normals);
    scenario.forcing = drawn.forcing;
    if is_random_start {
        scenario.initial = drawn.initial;
    }
    scenario.validate().map_err(to_python)?;
    Ok(Scenario(scenario))
}

/// Time, positions, velocities.
type TimedState = (f64, Vec<f64>, Vec<f64>);

/// Sets a scenario at its start, or at a state of another time.
fn engine(scenario: &Scenario, start: Option<TimedState>) -> PyResult<Engine> {
    let Some((time, positions, velocities)) = start else {
        return Engine::new(&scenario.0).map_err(to_python);
    };
    let state = State { time, positions, velocities };
    let engine = Engine::from_state(&scenario.0, &state);
    engine.map_err(|error| PyValueError::new_err(format!("start: {error}")))
}

/// Runs an engine to `until`, and gives all events to `receive` until Ctrl-C.
fn run(
    engine: &mut Engine,
    until: f64,
    stop: &AtomicBool,
    mut receive: impl FnMut(&Event),
) -> Result<(), Error> {
    let observer = |event: &Event, _: &Engine| {
        receive(event);
        if stop.load(Relaxed) { Break(()) } else { Continue(()) }
    };
    engine.run(until, observer).map(drop)
}

/// Times, gaps and closing speeds of all impacts up to a time.
///
/// Parameters
/// ----------
/// scenario : Scenario
/// until : float
/// start : (time, positions, velocities), optional
///     A state to go on from, at its time, as `states` gives it; the scenario may be another.
///
/// Returns
/// -------
/// time, gap, closing_speed : ndarray
///     In order of time; gap 0 is at the left wall (1 to n on a ring).
#[pyfunction]
#[pyo3(signature = (scenario, until, start = None))]
fn impacts<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    until: f64,
    start: Option<TimedState>,
) -> PyResult<(Array<'py>, Array<'py, u64>, Array<'py>)> {
    let mut engine = engine(scenario, start)?;
    let (times, gaps, speeds) = compute_detached(py, |stop| {
        let (mut times, mut gaps, mut speeds) = (Vec::new(), Vec::new(), Vec::new());
        run(&mut engine, until, stop, |event| {
            if let Event::Impact(impact) = event {
                times.push(impact.time);
                gaps.push(impact.gap as u64);
                speeds.push(impact.closing_speed);
            }
        })?;
        Ok((times, gaps, speeds))
    })?;
    Ok((times.into_pyarray(py), gaps.into_pyarray(py), speeds.into_pyarray(py)))
}

/// A dict in Python.
#[derive(IntoPyObject)]
struct EventFields {
    kind: &'static str,
    time: f64,
    gaps: Vec<usize>,
    closing_speed: Option<f64>,
}

impl EventFields {
    fn new(event: &Event) -> Option<EventFields> {
        let (kind, gaps, closing_speed) = match event {
            Event::Impact(impact) => ("impact", vec![impact.gap], Some(impact.closing_speed)),
            Event::Stick { gaps, .. } => ("stick", gaps.clone(), None),
            Event::Release { gaps, .. } => ("release", gaps.clone(), None),
            Event::Graze(graze) => ("graze", vec![graze.gap], None),
            _ => return None,
        };
        Some(EventFields { kind, time: event.time(), gaps, closing_speed })
    }
}

/// All events up to a time: impacts, gaps that stick and are released, undecided grazes.
///
/// Parameters
/// ----------
/// scenario, until, start
///     As for `impacts`.
///
/// Returns
/// -------
/// list of dict
///     With `kind` ("impact", "stick", "release", "graze"), `time`, `gaps`, and `closing_speed`,
///     which is None but for impacts.
#[pyfunction]
#[pyo3(signature = (scenario, until, start = None))]
fn events(
    py: Python<'_>,
    scenario: &Scenario,
    until: f64,
    start: Option<TimedState>,
) -> PyResult<Vec<EventFields>> {
    let mut engine = engine(scenario, start)?;
    compute_detached(py, |stop| {
        let mut events = Vec::new();
        run(&mut engine, until, stop, |event| events.extend(EventFields::new(event)))?;
        Ok(events)
    })
}

/// Positions and velocities of all masses at a time, or at rising times.
///
/// Parameters
/// ----------
/// at : float or array_like
/// scenario, start
///     As for `impacts`.
///
/// Returns
/// -------
/// positions, velocities : ndarray, shape (len(at), n)
///     At the time of an impact the velocities are those after it.
#[pyfunction]
#[pyo3(signature = (scenario, at, start = None))]
fn states<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    at: Bound<'py, PyAny>,
    start: Option<TimedState>,
) -> PyResult<(Matrix<'py>, Matrix<'py>)> {
    let at: Vec<f64> = at.extract().map(|time| vec![time]).or_else(|_| at.extract())?;
    if !at.is_sorted() {
        return Err(to_python(Error::input("at", "not in order", "give rising times")));
    }
    let shape = [at.len(), scenario.0.forcing.len()];
    let mut engine = engine(scenario, start)?;
    let (positions, velocities) = compute_detached(py, |stop| {
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        for time in at {
            check_range("at", time, engine.time(), LATEST)?;
            run(&mut engine, time, stop, |_| ())?;
            if stop.load(Relaxed) {
                break;
            }
            let state = engine.state(time)?;
            positions.extend(state.positions);
            velocities.extend(state.velocities);
        }
        Ok((positions, velocities))
    })?;
    let matrix = |values: Vec<f64>| values.into_pyarray(py).reshape(shape);
    Ok((matrix(positions)?, matrix(velocities)?))
}

#[pymodule]
mod _engine {
    #[pymodule_export]
    use super::ensemble::ensemble;
    #[pymodule_export]
    use super::{Scenario, draw, events, from_json, impacts, states};
}
