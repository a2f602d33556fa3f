//! This file calls a controller and looks, after every call, whether it wrote where it must not.

use rigproof_certify::foreign::MOST_POINTS;
use rigproof_certify::foreign::protocol::{ARC, Begin, CHAIN, SPLINE};
use rigproof_impl::tick::Sensed;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::library::Exports;
use crate::{
    RIGPROOF_CONTROLLER_MOST_POINTS, RIGPROOF_CONTROLLER_VERSION, RigproofControllerCommanded,
    RigproofControllerSensed, RigproofControllerSettings, RigproofControllerTask,
};

const _: () = assert!(MOST_POINTS == RIGPROOF_CONTROLLER_MOST_POINTS);
// What is told within this project is what the header calls it.
const _: () = assert!(
    CHAIN == RigproofControllerTask::Chain as u32
        && ARC == RigproofControllerTask::Arc as u32
        && SPLINE == RigproofControllerTask::Spline as u32
);

/// Words of a canary on each side.
const WORDS: usize = 64;

/// A struct of C between two canaries.
#[repr(C)]
pub struct Guarded<T> {
    before: [u64; WORDS],
    /// What is handed over.
    pub inside: T,
    after: [u64; WORDS],
}

// Nothing lies between a struct and its canaries.
const _: () = assert!(
    size_of::<RigproofControllerCommanded>().is_multiple_of(8)
        && size_of::<RigproofControllerSensed>().is_multiple_of(8)
        && size_of::<RigproofControllerSettings>().is_multiple_of(8)
);

/// What a canary holds: no two words alike, so that a copy from one place to another shows.
const CANARY: [u64; WORDS] = {
    let mut words = [0; WORDS];
    let mut index = 0;
    while index < WORDS {
        words[index] = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(index as u64 + 0x1234_5677);
        index += 1;
    }
    words
};

/// A controller and the memory that it is handed.
pub struct Controller {
    exports: Exports,
    settings: Box<Guarded<RigproofControllerSettings>>,
    sensed: Box<Guarded<RigproofControllerSensed>>,
    commanded: Box<Guarded<RigproofControllerCommanded>>,
}

/// What came of a call.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<T> {
    /// It answered 0.
    Answered(T),
    /// It answered another status.
    Status(i32),
    /// It wrote where it must not: where.
    WroteOutside(String),
}

impl Controller {
    /// A controller that is not begun.
    pub fn new(exports: Exports) -> Controller {
        Controller {
            exports,
            settings: guarded(of_nothing()),
            sensed: guarded(RigproofControllerSensed {
                size: size_of::<RigproofControllerSensed>() as u32,
                version: RIGPROOF_CONTROLLER_VERSION,
                number: 0,
                counts: [0; 2],
                reserved: 0,
                tip_force_n: [0.0; 2],
            }),
            commanded: guarded(RigproofControllerCommanded {
                size: size_of::<RigproofControllerCommanded>() as u32,
                version: RIGPROOF_CONTROLLER_VERSION,
                currents_a: [f64::NAN; 4],
            }),
        }
    }

    /// `init`.
    pub fn init(&mut self, begin: &Begin) -> Outcome<()> {
        let told = of(begin);
        let memory = &raw mut *self.settings;
        // SAFETY: the memory is this controller's own; what C is handed may be read, and what it writes beside it is looked for.
        let status = unsafe {
            (*memory).inside = told;
            (self.exports.init)(&raw const (*memory).inside)
        };
        match written("the settings", &self.settings)
            .or_else(|| changed_settings(&self.settings.inside, &told))
        {
            Some(place) => Outcome::WroteOutside(place),
            None if status == 0 => Outcome::Answered(()),
            None => Outcome::Status(status),
        }
    }

    /// `tick`.
    pub fn tick(&mut self, now: &Sensed<f64>) -> Outcome<[f64; 4]> {
        let force_n = [now.tip_force_n.x, now.tip_force_n.y];
        self.sensed.inside.number = now.number;
        self.sensed.inside.counts = now.counts;
        self.sensed.inside.tip_force_n = force_n;
        self.commanded.inside.size = size_of::<RigproofControllerCommanded>() as u32;
        self.commanded.inside.version = RIGPROOF_CONTROLLER_VERSION;
        self.commanded.inside.currents_a = [f64::NAN; 4];
        let told = self.sensed.inside;
        let (sensed, commanded) = (&raw mut *self.sensed, &raw mut *self.commanded);
        // SAFETY: both are this controller's own; what C is handed may be read and written, and what it writes beside it is looked for.
        let status = unsafe {
            (self.exports.tick)(&raw const (*sensed).inside, &raw mut (*commanded).inside)
        };
        let place = written("commanded", &self.commanded)
            .or_else(|| written("sensed", &self.sensed))
            .or_else(|| changed_sensed(&self.sensed.inside, &told));
        match place {
            Some(place) => Outcome::WroteOutside(place),
            None if status == 0 => Outcome::Answered(self.commanded.inside.currents_a),
            None => Outcome::Status(status),
        }
    }

    /// `shutdown`.
    pub fn shutdown(&mut self) -> Outcome<()> {
        // SAFETY: it takes nothing.
        unsafe { (self.exports.shutdown)() };
        let place =
            written("commanded", &self.commanded).or_else(|| written("sensed", &self.sensed));
        place.map_or(Outcome::Answered(()), Outcome::WroteOutside)
    }
}

/// A struct between whole canaries.
pub fn guarded<T>(inside: T) -> Box<Guarded<T>> {
    Box::new(Guarded {
        before: CANARY,
        inside,
        after: CANARY,
    })
}

/// Where a controller wrote beside a struct, if it did.
pub fn written<T>(name: &str, memory: &Guarded<T>) -> Option<String> {
    // The call went to code that the compiler does not see and that was handed these addresses: they are read anew.
    let memory = std::hint::black_box(memory);
    if memory.before == CANARY && memory.after == CANARY {
        return None;
    }
    let of = |words: &[u64; WORDS]| {
        let bytes = words.iter().flat_map(|word| word.to_ne_bytes());
        let whole = CANARY.iter().flat_map(|word| word.to_ne_bytes());
        let changed = bytes.zip(whole).enumerate();
        changed
            .filter(|(_, (byte, whole))| byte != whole)
            .map(|(place, _)| place)
            .collect::<Vec<usize>>()
    };
    let (before, after) = (of(&memory.before), of(&memory.after));
    let mut places = Vec::new();
    if let Some(last) = before.last() {
        let distance = 8 * WORDS - last;
        places.push(format!(
            "{} bytes before `{name}`, the nearest {distance} before its first",
            before.len()
        ));
    }
    if let Some(first) = after.first() {
        let distance = first + 1;
        places.push(format!(
            "{} bytes after `{name}`, the nearest {distance} after its last",
            after.len()
        ));
    }
    Some(places.join(", and "))
}

/// Whether a controller wrote into what it was told.
fn changed_sensed(
    now: &RigproofControllerSensed,
    told: &RigproofControllerSensed,
) -> Option<String> {
    let bits = |of: &RigproofControllerSensed| {
        let words = (of.size, of.version, of.number, of.counts, of.reserved);
        (words, of.tip_force_n.map(f64::to_bits))
    };
    let now = std::hint::black_box(now);
    (bits(now) != bits(told)).then(|| "into `sensed`, which may only be read".to_owned())
}

/// Whether a controller wrote into its settings. They are compared as text: once a trial, and what is no number equals itself.
fn changed_settings(
    now: &RigproofControllerSettings,
    told: &RigproofControllerSettings,
) -> Option<String> {
    let now = std::hint::black_box(now);
    (format!("{now:?}") != format!("{told:?}"))
        .then(|| "into the settings, which may only be read".to_owned())
}

/// The settings of C of a trial.
fn of(begin: &Begin) -> RigproofControllerSettings {
    let told = &begin.settings;
    let points_m = begin.points_m();
    let mut settings = RigproofControllerSettings {
        brakes: begin.brakes(),
        task: begin.task_number(),
        arms_m: begin.arms_m(),
        counts_per_turn: told.counts_per_turn,
        zero_counts: told.zero_counts,
        sample_s: told.sample_s,
        greatest_rate_rad_s: told.greatest_rate_rad_s,
        greatest_force_n: told.greatest_force_n,
        // No more come: the campaign refuses a longer path.
        points: points_m.len().min(MOST_POINTS) as u32,
        ..of_nothing()
    };
    for (place, point_m) in settings.points_m.iter_mut().zip(points_m) {
        *place = *point_m;
    }
    if let Some([x, y, radius_m, from_rad, to_rad]) = begin.arc() {
        settings.centre_m = [x, y];
        (settings.radius_m, settings.from_rad, settings.to_rad) = (radius_m, from_rad, to_rad);
    }
    settings
}

fn of_nothing() -> RigproofControllerSettings {
    RigproofControllerSettings {
        size: size_of::<RigproofControllerSettings>() as u32,
        version: RIGPROOF_CONTROLLER_VERSION,
        brakes: 0,
        task: 0,
        arms_m: [0.0; 5],
        counts_per_turn: [0; 2],
        zero_counts: [0; 2],
        sample_s: 0.0,
        greatest_rate_rad_s: 0.0,
        greatest_force_n: 0.0,
        greatest_current_a: GREATEST_CURRENT_A,
        points: 0,
        reserved: 0,
        centre_m: [0.0; 2],
        radius_m: 0.0,
        from_rad: 0.0,
        to_rad: 0.0,
        points_m: [[0.0; 2]; RIGPROOF_CONTROLLER_MOST_POINTS],
    }
}
