//! This file calls a controller of an axis and looks, after every call, whether it wrote where it must not.

use libloading::os::unix::Library;
use rigproof_certify::axis::controller::{Sensed, Settings};

use super::{
    RIGPROOF_AXIS_CONTROLLER_VERSION, RigproofAxisControllerCommanded,
    RigproofAxisControllerMotion, RigproofAxisControllerSensed, RigproofAxisControllerSettings,
};
use crate::call::{Guarded, Outcome, guarded, written};
use crate::library::{export, of_version};

// Nothing lies between a struct and its canaries.
const _: () = assert!(
    size_of::<RigproofAxisControllerCommanded>().is_multiple_of(8)
        && size_of::<RigproofAxisControllerSensed>().is_multiple_of(8)
        && size_of::<RigproofAxisControllerSettings>().is_multiple_of(8)
);

/// The header, as messages call it.
const HEADER: &str = "rigproof_axis_controller.h";
/// What every controller of an axis exports, and no other.
const VERSION: &str = "rigproof_axis_controller_version";

/// What a controller of an axis exports.
pub struct Exports {
    init: unsafe extern "C" fn(*const RigproofAxisControllerSettings) -> i32,
    tick: unsafe extern "C" fn(
        *const RigproofAxisControllerSensed,
        *mut RigproofAxisControllerCommanded,
    ) -> i32,
    shutdown: unsafe extern "C" fn(),
}

impl Exports {
    /// What a library exports; `None` where it is no controller of an axis.
    ///
    /// # Errors
    /// It is of another version, or lacks a function.
    pub fn of(library: &Library) -> Result<Option<Exports>, String> {
        // SAFETY: the header says this type of this name.
        let version = unsafe { export::<unsafe extern "C" fn() -> u32>(library, VERSION, HEADER) };
        let Ok(version) = version else {
            return Ok(None);
        };
        // SAFETY: it takes nothing.
        let version = unsafe { version() };
        of_version(version, RIGPROOF_AXIS_CONTROLLER_VERSION, HEADER)?;
        Ok(Some(Exports {
            // SAFETY: as of this version.
            init: unsafe { export(library, "rigproof_axis_controller_init", HEADER) }?,
            // SAFETY: as of this version.
            tick: unsafe { export(library, "rigproof_axis_controller_tick", HEADER) }?,
            // SAFETY: as of this version.
            shutdown: unsafe { export(library, "rigproof_axis_controller_shutdown", HEADER) }?,
        }))
    }
}

/// A controller of an axis and the memory that it is handed.
pub struct Controller {
    exports: Exports,
    settings: Box<Guarded<RigproofAxisControllerSettings>>,
    sensed: Box<Guarded<RigproofAxisControllerSensed>>,
    commanded: Box<Guarded<RigproofAxisControllerCommanded>>,
}

impl Controller {
    /// A controller that is not begun.
    pub fn new(exports: Exports) -> Controller {
        let settings = Settings::of(false, [0.0; 4]);
        Controller {
            exports,
            settings: guarded(of_settings(&settings)),
            sensed: guarded(of_sensed(&Sensed::of(0, [0.0; 5]))),
            commanded: guarded(unanswered()),
        }
    }

    /// `init`.
    pub fn init(&mut self, settings: &Settings) -> Outcome<()> {
        let told = of_settings(settings);
        let memory = &raw mut *self.settings;
        // SAFETY: the memory is this controller's own; what C is handed may be read, and what it writes beside it is looked for.
        let status = unsafe {
            (*memory).inside = told;
            (self.exports.init)(&raw const (*memory).inside)
        };
        let place = written("the settings", &self.settings)
            .or_else(|| changed("the settings", &self.settings.inside, &told));
        outcome(place, status, ())
    }

    /// `tick`.
    pub fn tick(&mut self, sensed: &Sensed) -> Outcome<f64> {
        let told = of_sensed(sensed);
        self.sensed.inside = told;
        self.commanded.inside = unanswered();
        let (sensed, commanded) = (&raw mut *self.sensed, &raw mut *self.commanded);
        // SAFETY: both are this controller's own; what C is handed may be read and written, and what it writes beside it is looked for.
        let status = unsafe {
            (self.exports.tick)(&raw const (*sensed).inside, &raw mut (*commanded).inside)
        };
        let place = written("commanded", &self.commanded)
            .or_else(|| written("sensed", &self.sensed))
            .or_else(|| changed("`sensed`", &self.sensed.inside, &told));
        outcome(place, status, self.commanded.inside.effort)
    }

    /// `shutdown`.
    pub fn shutdown(&mut self) -> Outcome<()> {
        // SAFETY: it takes nothing.
        unsafe { (self.exports.shutdown)() };
        let place =
            written("commanded", &self.commanded).or_else(|| written("sensed", &self.sensed));
        outcome(place, 0, ())
    }
}

fn outcome<T>(place: Option<String>, status: i32, answer: T) -> Outcome<T> {
    match place {
        Some(place) => Outcome::WroteOutside(place),
        None if status == 0 => Outcome::Answered(answer),
        None => Outcome::Status(status),
    }
}

/// Whether a controller wrote into what it was told.
fn changed<T: Copy + Words>(name: &str, now: &T, told: &T) -> Option<String> {
    let now = std::hint::black_box(now);
    (now.words() != told.words()).then(|| format!("into {name}, which may only be read"))
}

/// A struct of C as words that can be compared: what is no number equals itself.
trait Words {
    fn words(&self) -> ([u32; 4], Vec<u64>);
}

impl Words for RigproofAxisControllerSettings {
    fn words(&self) -> ([u32; 4], Vec<u64>) {
        let numbers = [
            self.sample_s,
            self.inertia,
            self.greatest_effort,
            self.position_quantum,
        ];
        let head = [self.size, self.version, self.motion, self.reserved];
        (head, numbers.map(f64::to_bits).to_vec())
    }
}

impl Words for RigproofAxisControllerSensed {
    fn words(&self) -> ([u32; 4], Vec<u64>) {
        let numbers = [
            self.position,
            self.velocity,
            self.effort,
            self.target_position,
            self.target_velocity,
        ];
        let head = [self.size, self.version, self.number, self.reserved];
        (head, numbers.map(f64::to_bits).to_vec())
    }
}

fn of_settings(settings: &Settings) -> RigproofAxisControllerSettings {
    let motion = match settings.is_rotary {
        false => RigproofAxisControllerMotion::Linear,
        true => RigproofAxisControllerMotion::Rotary,
    };
    RigproofAxisControllerSettings {
        size: size_of::<RigproofAxisControllerSettings>() as u32,
        version: RIGPROOF_AXIS_CONTROLLER_VERSION,
        motion: motion as u32,
        reserved: 0,
        sample_s: settings.sample_s,
        inertia: settings.inertia,
        greatest_effort: settings.greatest_effort,
        position_quantum: settings.position_quantum,
    }
}

fn of_sensed(sensed: &Sensed) -> RigproofAxisControllerSensed {
    RigproofAxisControllerSensed {
        size: size_of::<RigproofAxisControllerSensed>() as u32,
        version: RIGPROOF_AXIS_CONTROLLER_VERSION,
        number: sensed.number,
        reserved: 0,
        position: sensed.position,
        velocity: sensed.velocity,
        effort: sensed.effort,
        target_position: sensed.target_position,
        target_velocity: sensed.target_velocity,
    }
}

fn unanswered() -> RigproofAxisControllerCommanded {
    RigproofAxisControllerCommanded {
        size: size_of::<RigproofAxisControllerCommanded>() as u32,
        version: RIGPROOF_AXIS_CONTROLLER_VERSION,
        effort: f64::NAN,
    }
}
