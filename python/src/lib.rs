//! This file is the compiled part of the Python package: arrays in, a folder and curves out, everything else in Python.

use std::path::PathBuf;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigproof::door::{self, Asked, Recording, Rig};
use rigproof_trace::{Channel, Trace};

/// How often signals are looked for and progress is told.
const BEAT: Duration = Duration::from_millis(100);

/// A recording as Python gives it.
#[derive(FromPyObject)]
enum Given<'py> {
    /// A path.
    Path(PathBuf),
    /// A name, time stamps in seconds, and channels: name, unit, samples.
    Channels(
        String,
        PyReadonlyArray1<'py, f64>,
        Vec<(String, String, PyReadonlyArray1<'py, f64>)>,
    ),
}

/// A rig as Python gives it.
#[derive(FromPyObject)]
enum RigGiven {
    /// A path.
    Path(PathBuf),
    /// The text of a file, and its name.
    Text(String, String),
}

impl Given<'_> {
    /// The recording; each array is copied once, without a text between.
    fn taken(self) -> Recording {
        match self {
            Given::Path(path) => Recording::File(path),
            Given::Channels(name, time_s, channels) => {
                let channels = channels.into_iter().map(|(name, unit, samples)| Channel {
                    name,
                    unit,
                    samples: samples.as_array().to_vec(),
                });
                let trace = Trace {
                    time_s: time_s.as_array().to_vec(),
                    channels: channels.collect(),
                };
                Recording::Channels(name, trace)
            }
        }
    }
}

/// Diagnoses, writes the folder `out`, and gives the curves of its pictures. The interpreter's lock is free meanwhile; `tick` is called with the seconds that
/// have passed. After Ctrl-C the call ends at once; the thread that works ends by itself later.
#[pyfunction]
#[pyo3(signature = (recordings, rig, out, held_out=None, hold_out_share=None, between_s=(None, None), calibrate=None, jobs=0, tick=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
fn diagnose<'py>(
    py: Python<'py>,
    recordings: Vec<Given<'py>>,
    rig: RigGiven,
    out: PathBuf,
    held_out: Option<Given<'py>>,
    hold_out_share: Option<f64>,
    between_s: (Option<f64>, Option<f64>),
    calibrate: Option<usize>,
    jobs: usize,
    tick: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = Asked {
        recordings: recordings.into_iter().map(Given::taken).collect(),
        held_out: held_out.map(Given::taken),
        rig: match rig {
            RigGiven::Path(path) => Rig::File(path),
            RigGiven::Text(text, name) => Rig::Text(text, name),
        },
        hold_out_share,
        between_s: [between_s.0, between_s.1],
        calibrate,
        jobs,
        out,
    };
    let (sender, mut receiver) = channel();
    std::thread::spawn(move || sender.send(door::diagnose(asked)));
    let begun = Instant::now();
    loop {
        let got;
        (got, receiver) = py.detach(move || (receiver.recv_timeout(BEAT), receiver));
        match got {
            Ok(Ok(curves)) => return drawn(py, &curves),
            Ok(Err(refused)) => return Err(PyValueError::new_err(refused.0)),
            Err(RecvTimeoutError::Disconnected) => {
                let problem = "the diagnosis broke off; what went wrong stands on the error stream";
                return Err(PyRuntimeError::new_err(problem));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        py.check_signals()?;
        if let Some(tick) = &tick {
            tick.call1((begun.elapsed().as_secs_f64(),))?;
        }
    }
}

/// The curves of the held-out part as arrays.
fn drawn<'py>(py: Python<'py>, curves: &door::Curves) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, samples) in [
        ("time_s", &curves.time_s),
        ("recorded", &curves.recorded),
        ("before", &curves.before),
        ("after", &curves.after),
        ("window_time_s", &curves.window_time_s),
        ("residual_before", &curves.residual_before),
        ("residual_after", &curves.residual_after),
    ] {
        all.set_item(name, PyArray1::from_slice(py, samples))?;
    }
    all.set_item("output", curves.output)?;
    all.set_item("unit", &curves.unit)?;
    all.set_item("residual_unit", &curves.residual_unit)?;
    Ok(all)
}

/// The compiled part of the package `rigproof`.
#[pymodule]
fn _rigproof(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(diagnose, module)?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
