//! Offers the engine to Python: scenarios, their events and states, and ensembles, as arrays.

mod arguments;

use arguments::{chain_from, json_value, json_values, refused, to_python, whole_number};
use impact_chain::{
    Abreast, Counting, Counts, Engine, Error, Event, Impact, NormalPairs, Protocol, Seed, State,
    Watch,
};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;
use serde_json::Value;
use std::ops::ControlFlow::{Break, Continue};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

type Array<'py, T = f64> = Bound<'py, PyArray1<T>>;
type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Computes without the lock of Python, which sees Ctrl-C all the while: `compute` then finds the
/// flag set, and what it returns is dropped.
fn compute_detached<T: Send>(
    py: Python<'_>,
    compute: impl FnOnce(&AtomicBool) -> Result<T, Error> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    py.detach(|| {
        let (sender, receiver) = channel();
        std::thread::scope(|scope| {
            let stop = &stop;
            scope.spawn(move || sender.send(compute(stop)));
            loop {
                match receiver.recv_timeout(Duration::from_millis(50)) {
                    Ok(result) => return result.map_err(to_python),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(interrupt) = Python::attach(|py| py.check_signals()) {
                            stop.store(true, Relaxed);
                            return Err(interrupt);
                        }
                    }
                    // The thread has panicked, and so does the scope.
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("the engine has panicked"));
                    }
                }
            }
        })
    })
}

/// One chain with the amplitudes of its forcing and its start.
///
/// Parameters
/// ----------
/// forcing : array_like, shape (n, 2)
///     Amplitudes of cos(Ωt) and sin(Ωt) of each mass; (m, n, 2) with `forcing_frequencies`.
/// **fields
///     The other fields of a scenario in JSON, such as `restitution`, `spacing`,
///     `natural_frequency`, `forcing_frequency`, `boundary` ("walls" or "ring"), `places`, `walls`
///     and `initial`: "rest", "zero", {"free": pairs} or
///     {"at": {"positions": …, "velocities": …}}.
///
/// Raises
/// ------
/// ValueError, TypeError
///     A field is not allowed; the message names it and says what to write instead.
#[pyclass(frozen, eq, module = "impact_chain")]
#[derive(PartialEq)]
struct Scenario(impact_chain::Scenario);

#[pymethods]
impl Scenario {
    #[new]
    #[pyo3(signature = (*, forcing, **fields))]
    fn new(forcing: Bound<'_, PyAny>, fields: Option<Bound<'_, PyDict>>) -> PyResult<Scenario> {
        let mut values = json_values(fields.as_ref())?;
        values.insert("forcing".into(), json_value("forcing", &forcing)?);
        Scenario::from_json(&Value::Object(values).to_string())
    }

    /// Reads a scenario from JSON, as `impact-paper trace` does.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Scenario> {
        impact_chain::Scenario::from_json(text).map(Scenario).map_err(to_python)
    }

    /// Draws the forcing from normals, and a random start too.
    ///
    /// Parameters
    /// ----------
    /// sigma : float
    ///     Standard deviation of the amplitudes.
    /// index, stream, seed
    ///     Of the realisation, which has the same normals at every sigma.
    /// **chain
    ///     Fields of the chain: masses, restitution, boundary, initial ("rest", "zero" or
    ///     "random"), …
    #[staticmethod]
    #[pyo3(signature = (sigma, index = 0, *, stream = "sweep", seed = 2007, **chain))]
    fn draw(
        sigma: f64,
        index: i128,
        stream: &str,
        seed: i128,
        chain: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Scenario> {
        let (index, seed) = (whole_number("index", index)?, whole_number("seed", seed)?);
        let mut normals = NormalPairs::new(stream, Seed(seed), index);
        let scenario = impact_chain::Scenario::draw(&chain_from(chain)?, sigma, &mut normals);
        scenario.validate().map_err(to_python)?;
        Ok(Scenario(scenario))
    }

    /// Writes the scenario as JSON in one line.
    fn to_json(&self) -> String {
        self.0.to_json()
    }

    /// Returns the fields of the scenario: `Scenario(**scenario.to_dict())` is the same.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (self.to_json(),))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.get_type::<Scenario>().getattr("from_json")?, (self.to_json(),)))
    }

    fn __repr__(&self) -> String {
        let scenario = &self.0;
        format!("<Scenario: {} masses, r = {}>", scenario.forcing.len(), scenario.restitution)
    }
}

/// A state to go on from: time, positions, velocities.
type Start = Option<(f64, Vec<f64>, Vec<f64>)>;

/// Sets a scenario at its start, or at a state of another time, which `first` must not precede.
fn engine(scenario: &Scenario, start: Start, first: f64) -> PyResult<Engine> {
    let engine = match start {
        None => Engine::new(&scenario.0),
        Some((time, positions, velocities)) => {
            Engine::from_state(&scenario.0, &State { time, positions, velocities })
        }
    };
    let engine = engine.map_err(|error| match error.field() {
        Some(field) if ["time", "positions", "velocities"].iter().any(|f| field.starts_with(f)) => {
            refused("start", error)
        }
        _ => to_python(error),
    })?;
    let begin = engine.time();
    if first < begin {
        let message = format!("{first:?} is before the start at t = {begin:?}; give a later time");
        return Err(PyValueError::new_err(message));
    }
    Ok(engine)
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
    start: Start,
) -> PyResult<(Array<'py>, Array<'py, u64>, Array<'py>)> {
    let mut engine = engine(scenario, start, until)?;
    let impacts = compute_detached(py, |stop| {
        let mut impacts = Vec::new();
        run(&mut engine, until, stop, |event| {
            if let Event::Impact(impact) = event {
                impacts.push(*impact);
            }
        })?;
        Ok(impacts)
    })?;
    let array = |value: fn(&Impact) -> f64| PyArray1::from_iter(py, impacts.iter().map(value));
    let gaps = PyArray1::from_iter(py, impacts.iter().map(|impact| impact.gap as u64));
    Ok((array(|impact| impact.time), gaps, array(|impact| impact.closing_speed)))
}

/// All events up to a time: impacts, gaps that stick and are released, undecided grazes.
///
/// Returns
/// -------
/// list of dict
///     With `kind` ("impact", "stick", "release", "graze"), `time` and `gaps`; an impact has
///     `closing_speed`.
#[pyfunction]
#[pyo3(signature = (scenario, until, start = None))]
fn events<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    until: f64,
    start: Start,
) -> PyResult<Bound<'py, PyList>> {
    let mut engine = engine(scenario, start, until)?;
    let events = compute_detached(py, |stop| {
        let mut events = Vec::new();
        run(&mut engine, until, stop, |event| events.push(event.clone()))?;
        Ok(events)
    })?;
    let list = PyList::empty(py);
    for event in events {
        let entry = PyDict::new(py);
        let (kind, gaps) = match &event {
            Event::Impact(impact) => {
                entry.set_item("closing_speed", impact.closing_speed)?;
                ("impact", vec![impact.gap])
            }
            Event::Stick { gaps, .. } => ("stick", gaps.clone()),
            Event::Release { gaps, .. } => ("release", gaps.clone()),
            Event::Graze(graze) => ("graze", vec![graze.gap]),
            _ => continue,
        };
        entry.set_item("kind", kind)?;
        entry.set_item("time", event.time())?;
        entry.set_item("gaps", gaps)?;
        list.append(entry)?;
    }
    Ok(list)
}

/// Positions and velocities of all masses at a time, or at rising times.
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
    start: Start,
) -> PyResult<(Matrix<'py>, Matrix<'py>)> {
    let at: Vec<f64> = at.extract().map(|time| vec![time]).or_else(|_| at.extract())?;
    if !at.is_sorted() {
        return Err(refused("at", "give rising times"));
    }
    let shape = [at.len(), scenario.0.forcing.len()];
    let mut engine = engine(scenario, start, at.first().copied().unwrap_or(f64::MAX))?;
    let (positions, velocities) = compute_detached(py, |stop| {
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        for time in at {
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
    let array = |values| PyArray1::from_vec(py, values).reshape(shape);
    Ok((array(positions)?, array(velocities)?))
}

/// Counts the impacts of many random chains in a window of time, on all cores.
///
/// Parameters
/// ----------
/// sigma : float
///     Standard deviation of the amplitudes of the forcing.
/// realisations : int
/// transient, window : float
///     Impacts are counted from `transient` up to `transient + window`.
/// stream, seed
///     Of the random numbers: realisation i is `Scenario.draw(sigma, i, ...)`.
/// **chain
///     Fields of the chain: masses, restitution, boundary, initial, …
///
/// Returns
/// -------
/// distinct, impacts : ndarray of int64
///     For each realisation the gaps with an impact, −1 where the start overlaps or the engine
///     ended the run early, and the number of impacts.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
#[pyo3(signature = (sigma, realisations, *, transient = 500.0, window = 200.0, stream = "sweep",
    seed = 2007, **chain))]
fn ensemble<'py>(
    py: Python<'py>,
    sigma: f64,
    realisations: i128,
    transient: f64,
    window: f64,
    stream: &str,
    seed: i128,
    chain: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Array<'py, i64>, Array<'py, i64>)> {
    if !(sigma >= 0.0 && transient >= 0.0 && window > 0.0) {
        let message = "sigma, transient, window: give no negative number, and a window above 0";
        return Err(PyValueError::new_err(message));
    }
    let realisations = whole_number("realisations", realisations)?;
    let seed = whole_number("seed", seed)?;
    let (chain, windows) = (chain_from(chain)?, [Protocol { transient, window }]);
    let until = windows[0].end();
    let counts = compute_detached(py, |stop| {
        let stopped = || stop.load(Relaxed);
        let counting = Counting::new(&chain, &windows, until);
        let draw = |index| {
            impact_chain::Scenario::draw(
                &chain,
                sigma,
                &mut NormalPairs::new(stream, Seed(seed), index),
            )
        };
        let batch = Abreast::batch_size(&chain) as u64;
        let starts: Vec<u64> = (0..realisations).step_by(batch as usize).collect();
        let count = |first: &u64| -> Result<Vec<[i64; 2]>, Error> {
            if stopped() {
                return Ok(Vec::new());
            }
            let indices = *first..(first + batch).min(realisations);
            let starts = indices.map(|index| (index, Some(draw(index)))).collect();
            let runs = counting.run(starts, |index| Engine::new(&draw(index)), &stopped)?;
            let row = |(counts, _): &(Counts, Watch)| {
                let distinct = counts.distinct[0][0].map_or(-1, i64::from);
                [distinct, counts.impacts[0][0] as i64]
            };
            Ok(runs.iter().map(row).collect())
        };
        starts.par_iter().map(count).collect::<Result<Vec<_>, Error>>()
    })?;
    let column =
        |place: usize| PyArray1::from_iter(py, counts.iter().flatten().map(|counts| counts[place]));
    Ok((column(0), column(1)))
}

/// Chains of forced masses with impacts, simulated exactly from event to event.
#[pymodule(name = "impact_chain")]
fn python_module(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<Scenario>()?;
    module.add_function(wrap_pyfunction!(impacts, module)?)?;
    module.add_function(wrap_pyfunction!(events, module)?)?;
    module.add_function(wrap_pyfunction!(states, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble, module)?)
}
