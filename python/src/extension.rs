//! This file is the compiled part of the Python package: arrays in, a folder and curves out, everything else in Python.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PySlice};
use rigproof::door::{self, Asked, Doing, Recording, Rig, Stop};
use rigproof_trace::{Channel, Trace};

/// How often signals are looked for and progress is told.
const BEAT: Duration = Duration::from_millis(100);

/// A recording as Python gives it.
#[derive(FromPyObject)]
enum Given<'py> {
    /// A path.
    Path(PathBuf),
    /// A name, time stamps in seconds, and channels: name, unit, samples. Arrays of numpy, or what gives one for a slice, of any kind of real numbers.
    Channels(
        String,
        Bound<'py, PyAny>,
        Vec<(String, String, Bound<'py, PyAny>)>,
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
    /// The recording; each array is copied once, in parts, without a text between.
    fn taken(self) -> PyResult<Recording> {
        match self {
            Given::Path(path) => Ok(Recording::File(path)),
            Given::Channels(name, time_s, channels) => {
                let channels = channels.into_iter().map(|(name, unit, array)| {
                    let samples = floats(&array)?;
                    Ok(Channel {
                        name,
                        unit,
                        samples,
                    })
                });
                let trace = Trace {
                    time_s: floats(&time_s)?,
                    channels: channels.collect::<PyResult<_>>()?,
                };
                Ok(Recording::Channels(name, trace))
            }
        }
    }
}

/// How many samples pass at once as bytes: the stable interface of Python 3.10 has no view of an array.
const PART: usize = 1 << 17;

/// The samples of an array as 64-bit floats, whatever its kind and its strides.
fn floats(array: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let length = array.len()?;
    let mut all = Vec::with_capacity(length);
    for from in (0..length).step_by(PART) {
        let to = (from + PART).min(length);
        let part = array.get_item(PySlice::new(array.py(), from as isize, to as isize, 1))?;
        let floats = part.call_method1("astype", ("=f8",))?;
        let bytes = floats.call_method0("tobytes")?.cast_into::<PyBytes>()?;
        let (floats, _) = bytes.as_bytes().as_chunks();
        all.extend(floats.iter().copied().map(f64::from_ne_bytes));
    }
    Ok(all)
}

/// Diagnoses, writes the folder `out`, and gives the curves of its pictures. The interpreter's lock is free meanwhile; `tick` is called with the seconds that
/// have passed and with what is worked on. After Ctrl-C the call ends at once, and the thread that works at its next column or fit.
#[pyfunction]
#[pyo3(signature = (recordings, rig, out, held_out=None, hold_out_share=None, from_s=None, to_s=None, calibrate=None, jobs=0, tick=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
fn diagnose<'py>(
    py: Python<'py>,
    recordings: Vec<Given<'py>>,
    rig: RigGiven,
    out: PathBuf,
    held_out: Option<Given<'py>>,
    hold_out_share: Option<f64>,
    from_s: Option<f64>,
    to_s: Option<f64>,
    calibrate: Option<usize>,
    jobs: usize,
    tick: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = Asked {
        recordings: recordings
            .into_iter()
            .map(Given::taken)
            .collect::<PyResult<_>>()?,
        held_out: held_out.map(Given::taken).transpose()?,
        rig: match rig {
            RigGiven::Path(path) => Rig::File(path),
            RigGiven::Text(text, name) => Rig::Text(text, name),
        },
        hold_out_share,
        between_s: [from_s, to_s],
        calibrate,
        jobs,
        out,
        stop: Stop::default(),
        doing: Doing::default(),
    };
    let doing = asked.doing.clone();
    let _stop = Ended(asked.stop.clone());
    let (sender, mut receiver) = channel();
    WORKING.fetch_add(1, Ordering::Relaxed);
    std::thread::spawn(move || {
        let _done = Done;
        sender.send(door::diagnose(asked))
    });
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
            let words = doing.lock().map_or("", |words| *words);
            tick.call1((begun.elapsed().as_secs_f64(), words))?;
        }
    }
}

/// How many diagnoses are worked on.
static WORKING: AtomicUsize = AtomicUsize::new(0);

/// Counts one less, however its work ends.
struct Done;

impl Drop for Done {
    fn drop(&mut self) {
        WORKING.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Ends the work when nobody waits for it any more.
struct Ended(Stop);

impl Drop for Ended {
    fn drop(&mut self) {
        self.0.stop();
    }
}

/// How many diagnoses are worked on in this process; one that was interrupted counts until its thread has ended.
#[pyfunction]
fn working() -> usize {
    WORKING.load(Ordering::Relaxed)
}

/// The curves of the held-out part, each the bytes of 64-bit floats.
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
        let bytes: Vec<u8> = samples.iter().flat_map(|x| x.to_ne_bytes()).collect();
        all.set_item(name, PyBytes::new(py, &bytes))?;
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
    module.add_function(wrap_pyfunction!(working, module)?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
