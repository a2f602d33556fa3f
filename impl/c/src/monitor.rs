//! This file is the monitor of a certificate for a program in C.

use rigproof_impl::monitor::constants::{Constants, NUMBERS, WATCHED};
use rigproof_impl::monitor::{Alarm, Monitor};
use rigproof_impl::tick::Sensed;
use rigproof_spec::inertia::{ArmInertia, Inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, TimeConstantFit, TorqueGainFit};

use crate::{
    RIGPROOF_TICK_VERSION, RigproofTickCommand, RigproofTickSensed, RigproofTickSettings,
    RigproofTickStatus, Versioned, is_of_this_version, is_usable,
};

/// Size of a monitor, words of eight bytes.
pub const RIGPROOF_MONITOR_WORDS: usize = 3584;

/// Numbers that a monitor watches: gains and levels of A, E, B, C, bias of A and B.
pub const RIGPROOF_MONITOR_WATCHED: usize = 10;
/// Numbers that it estimates: those, slowness of A, E, B, C, the masses of both sides, and the payload.
pub const RIGPROOF_MONITOR_NUMBERS: usize = 17;

const _: () = assert!(RIGPROOF_MONITOR_WATCHED == WATCHED && RIGPROOF_MONITOR_NUMBERS == NUMBERS);

/// What marks a monitor that was created by a library of this version whose monitors are of this size.
const MARK: u64 =
    0x5249_4750_4d4f_4e49 ^ ((RIGPROOF_TICK_VERSION as u64) << 32) ^ size_of::<Monitor>() as u64;

/// A brake as a certificate has it, with the coefficients of tables 3.1 to 3.3 in their order.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofMonitorBrake {
    /// Width of the backlash, degrees.
    pub backlash_width_deg: f64,
    /// k1 to k5 of the torque gain (3.3).
    pub torque_gain: [f64; 5],
    /// `a_avg` and a1 to a6 of the rising time constant (3.5).
    pub rising: [f64; 7],
    /// The same of the falling one (3.6).
    pub falling: [f64; 7],
    /// Currents that were measured, A.
    pub current_range_a: [f64; 2],
    /// Speeds that were measured, rpm.
    pub speed_range_rpm: [f64; 2],
}

/// What is certified, and how sure the monitor has to be. `rigproof certify monitor` writes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigproofMonitorConstants {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    /// How many brakes: 3 (A, E, B) or 4 (A, E, B, C).
    pub brakes: u32,
    /// Samples in a row outside of what was covered that raise an alarm.
    pub hold: u32,
    /// Samples in a row without a good one that raise an alarm.
    pub longest_fault: u32,
    /// 0.
    pub reserved: u32,
    /// The cells in which samples lay, a bit each.
    pub cells: u64,
    /// Mass, kg, inertia about the centre of mass, kg·m², and its distance from the first joint, m, of AE, ED, BC, CD.
    pub arms: [[f64; 3]; 4],
    /// Mass at the tip, kg.
    pub payload_kg: f64,
    /// The brakes A, E, B, C.
    pub brake: [RigproofMonitorBrake; 4],
    /// Viscous friction of A, E, B, C, N·m·s/rad.
    pub viscous_nm_s: [f64; 4],
    /// Dry friction beside the brakes', N·m.
    pub dry_nm: [f64; 4],
    /// Constant torque against each joint, N·m.
    pub constant_nm: [f64; 4],
    /// Share by which the width of a backlash may be another.
    pub backlash_share: f64,
    /// Lower ends of gains and levels of A, E, B, C, bias of A and B, slowness of A, E, B, C, masses of both sides, and payload.
    pub low: [f64; RIGPROOF_MONITOR_NUMBERS],
    /// Their upper ends.
    pub high: [f64; RIGPROOF_MONITOR_NUMBERS],
    /// Their spreads.
    pub spread: [f64; RIGPROOF_MONITOR_NUMBERS],
    /// Time over which the monitor forgets what it learned, s.
    pub memory_s: f64,
    /// Shares of inertial and braking impulses that the model may miss.
    pub missed_share: [f64; 2],
    /// By how many standard deviations a number has to be beyond its end.
    pub levels: [f64; RIGPROOF_MONITOR_WATCHED],
    /// Greatest mean square of the normalised surprise.
    pub surprise: f64,
    /// Least and greatest x, least and greatest y of the tip, m.
    pub tip_m: [f64; 4],
    /// Greatest speed of the tip, m/s.
    pub speed_m_s: f64,
    /// Greatest force on it, N.
    pub force_n: f64,
    /// What lies farther from the base joints' line is far, m.
    pub far_m: f64,
    /// Speeds between still, slow and fast, m/s.
    pub speeds_m_s: [f64; 2],
    /// Forces between light, middle and strong, N.
    pub forces_n: [f64; 2],
}

/// Why the rig is not what was certified.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigproofMonitorAlarm {
    /// It is, as far as was seen.
    None = 0,
    /// No good sample came for longer than in any trial.
    Sensor = 1,
    /// A command is no current of a brake that is there.
    Command = 2,
    /// The tip is where it was in no trial.
    Place = 3,
    /// The tip is faster than in any trial.
    Speed = 4,
    /// The hand pushes harder than in any trial.
    Force = 5,
    /// Place, speed and force came together in no trial.
    Cell = 6,
    /// The torque that current makes at a joint's brake is outside its interval.
    Gain = 7,
    /// Friction without current at a joint is outside its interval.
    Friction = 8,
    /// A constant torque at A or B is outside its interval.
    Bias = 9,
    /// The motion is further from the model than in any trial.
    Motion = 10,
}

/// What the monitor makes of a sample.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RigproofMonitorReport {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    /// A number of `RigproofMonitorAlarm`; once it is not 0 it stays.
    pub alarm: u32,
    /// The joint that it names, 0 to 3 in the order A, E, B, C; -1 for none.
    pub joint: i32,
    /// Whether a sensor is wrong in this sample.
    pub is_faulty: u32,
}

/// A monitor. Its memory is the caller's and its content, but for size and version, this library's.
#[repr(C)]
pub struct RigproofMonitor {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    mark: u64,
    words: [u64; RIGPROOF_MONITOR_WORDS],
}

const _: () = assert!(
    size_of::<Monitor>() <= 8 * RIGPROOF_MONITOR_WORDS
        && align_of::<Monitor>() <= align_of::<u64>()
);

impl Versioned for RigproofMonitor {}
impl Versioned for RigproofMonitorConstants {}
impl Versioned for RigproofMonitorReport {}

/// Makes a monitor in `monitor` that has seen nothing, for the rig of a tick's settings.
///
/// # Safety
/// Each pointer must be null or point to as many bytes as its size says; `monitor` to bytes that may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_monitor_create(
    monitor: *mut RigproofMonitor,
    settings: *const RigproofTickSettings,
    constants: *const RigproofMonitorConstants,
) -> RigproofTickStatus {
    if !is_usable(monitor) || !is_usable(settings) || !is_usable(constants) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(monitor) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size, and the caller's to write.
    unsafe { (&raw mut (*monitor).mark).write(0) };
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(settings) || !is_of_this_version(constants) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, and of this very size; every pattern of bits is one of their numbers.
    let (settings, constants) = unsafe { (&*settings, &*constants) };
    let made = settings
        .tick()
        .filter(|_| settings.brakes == constants.brakes)
        .and_then(|settings| Monitor::new(&settings, &constants.constants()));
    let Some(made) = made else {
        return RigproofTickStatus::BadSettings;
    };
    // SAFETY: the words are the caller's to write, large enough and aligned for a monitor (asserted above).
    unsafe {
        (&raw mut (*monitor).words).cast::<Monitor>().write(made);
        (&raw mut (*monitor).mark).write(MARK);
    }
    RigproofTickStatus::Ok
}

/// Watches a sample and the command that the tick gave for it, and lets go where it has to: then the command has no current. Bounded work,
/// whatever is told. As of `rigproof_tick_step`, a caller takes every status but `OK` for no current.
///
/// # Safety
/// Each pointer must be null or point to as many bytes as its size says; `monitor` to a monitor that was created and that no other
/// thread uses; `command` and `report` to bytes that may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_monitor_watch(
    monitor: *mut RigproofMonitor,
    sensed: *const RigproofTickSensed,
    command: *mut RigproofTickCommand,
    report: *mut RigproofMonitorReport,
) -> RigproofTickStatus {
    if !is_usable(command) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(command) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size; every pattern of bits is one of its numbers.
    let asked = unsafe { *command };
    // SAFETY: the same, and the caller's to write. Whatever goes wrong from here on, no brake has current.
    unsafe { (&raw mut (*command).currents_a).write([0.0; 4]) };
    if !is_usable(monitor) || !is_usable(sensed) || !is_usable(report) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe {
        !is_of_this_version(monitor) || !is_of_this_version(sensed) || !is_of_this_version(report)
    } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size, and the caller's to read.
    if unsafe { (&raw const (*monitor).mark).read() } != MARK {
        return RigproofTickStatus::NotCreated;
    }
    // SAFETY: not null, aligned; every pattern of bits is one of its numbers.
    let sensed = unsafe { *sensed };
    // SAFETY: the mark says that `rigproof_monitor_create` wrote a monitor there, and nobody else uses it.
    let own = unsafe { &mut *(&raw mut (*monitor).words).cast::<Monitor>() };
    let watched = own.watch(
        &Sensed {
            number: sensed.number,
            counts: sensed.counts,
            tip_force_n: sensed.tip_force_n.into(),
        },
        asked.currents_a,
    );
    let (alarm, joint) = watched.alarm.map_or((RigproofMonitorAlarm::None, -1), word);
    // SAFETY: both are not null, aligned, of their size, and the caller's to write.
    unsafe {
        (&raw mut (*command).currents_a).write(watched.currents_a);
        report.write(RigproofMonitorReport {
            size: size_of::<RigproofMonitorReport>() as u32,
            version: RIGPROOF_TICK_VERSION,
            alarm: alarm as u32,
            joint,
            is_faulty: u32::from(watched.is_faulty),
        });
    }
    RigproofTickStatus::Ok
}

/// What C calls an alarm, and the joint that it names.
pub fn word(alarm: Alarm) -> (RigproofMonitorAlarm, i32) {
    use RigproofMonitorAlarm as Word;
    let of = |joint: Joint| joint as i32;
    match alarm {
        Alarm::Sensor => (Word::Sensor, -1),
        Alarm::Command => (Word::Command, -1),
        Alarm::Place => (Word::Place, -1),
        Alarm::Speed => (Word::Speed, -1),
        Alarm::Force => (Word::Force, -1),
        Alarm::Cell => (Word::Cell, -1),
        Alarm::Gain(joint) => (Word::Gain, of(joint)),
        Alarm::Friction(joint) => (Word::Friction, of(joint)),
        Alarm::Bias(joint) => (Word::Bias, of(joint)),
        Alarm::Motion => (Word::Motion, -1),
    }
}

impl RigproofMonitorConstants {
    /// As the monitor takes them.
    pub fn constants(&self) -> Constants {
        let arm = |[mass_kg, inertia_kg_m2, centre_m]: [f64; 3]| ArmInertia {
            mass_kg,
            inertia_kg_m2,
            centre_m,
        };
        let [ae, ed, bc, cd] = self.arms.map(arm);
        Constants {
            inertia: Inertia {
                ae,
                ed,
                bc,
                cd,
                payload_kg: self.payload_kg,
            },
            brakes: self.brake.map(|brake| brake.table()),
            viscous_nm_s: self.viscous_nm_s,
            dry_nm: self.dry_nm,
            constant_nm: self.constant_nm,
            backlash_share: self.backlash_share,
            low: self.low,
            high: self.high,
            spread: self.spread,
            memory_s: self.memory_s,
            missed_share: self.missed_share,
            levels: self.levels,
            surprise: self.surprise,
            tip_m: self.tip_m,
            speed_m_s: self.speed_m_s,
            force_n: self.force_n,
            far_m: self.far_m,
            speeds_m_s: self.speeds_m_s,
            forces_n: self.forces_n,
            cells: self.cells,
            hold: self.hold,
            longest_fault: self.longest_fault,
        }
    }
}

impl RigproofMonitorBrake {
    fn table(&self) -> BrakeTable {
        let [k_1, k_2, k_3, k_4, k_5] = self.torque_gain;
        let fit = |[a_avg_s, a_1, a_2, a_3, a_4, a_5, a_6]: [f64; 7]| TimeConstantFit {
            a_avg_s,
            a_1,
            a_2,
            a_3,
            a_4,
            a_5,
            a_6,
            // How well a fit fits moves no brake.
            r_squared: 1.0,
        };
        BrakeTable {
            backlash_width_deg: self.backlash_width_deg,
            torque_gain: TorqueGainFit {
                k_1,
                k_2,
                k_3,
                k_4,
                k_5,
                r_squared: 1.0,
            },
            rising: fit(self.rising),
            falling: fit(self.falling),
            current_range_a: self.current_range_a,
            speed_range_rpm: self.speed_range_rpm,
        }
    }
}
