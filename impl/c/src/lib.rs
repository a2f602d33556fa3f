//! This file is the tick of the controller for a program in C: no heap, fixed sizes, an error code for all that can be checked.
#![no_std]
#![expect(
    unsafe_code,
    reason = "what C hands over are pointers; each is checked for null and alignment, and trusted for the rest"
)]

#[cfg(feature = "std")]
extern crate std;

mod monitor;
mod settings;
mod words;

use rigproof_impl::law::PathLaw;
use rigproof_impl::path::AnyPath;
use rigproof_impl::tick::{Sensed, Tick};

pub use monitor::{
    RIGPROOF_MONITOR_NUMBERS, RIGPROOF_MONITOR_WATCHED, RIGPROOF_MONITOR_WORDS, RigproofMonitor,
    RigproofMonitorAlarm, RigproofMonitorBrake, RigproofMonitorConstants, RigproofMonitorReport,
    rigproof_monitor_create, rigproof_monitor_watch, word as monitor_word,
};
pub use settings::{RIGPROOF_MOST_CORNERS, RigproofTickSettings, rigproof_tick_thesis};
pub use words::{
    RigproofTickCommand, RigproofTickLaw, RigproofTickReason, RigproofTickSensed,
    RigproofTickStatus,
};

/// Version of every struct and function here. Every struct begins with its size and this version, which the caller writes before it hands the
/// struct over; one of another size or version is refused. Nothing is written to it, but a command that differs in its version alone loses its
/// currents.
pub const RIGPROOF_TICK_VERSION: u32 = 2;
/// Size of a controller, words of eight bytes.
pub const RIGPROOF_TICK_WORDS: usize = 384;

/// What marks a controller that was created by a library of this version whose controllers are of this size.
const MARK: u64 =
    0x5249_4750_524f_4f46 ^ ((RIGPROOF_TICK_VERSION as u64) << 32) ^ size_of::<Controller>() as u64;

/// A controller. Its memory is the caller's and its content, but for size and version, this library's; it may be copied with memcpy.
#[repr(C)]
pub struct RigproofTick {
    /// Size of this struct, bytes.
    pub size: u32,
    /// `RIGPROOF_TICK_VERSION`.
    pub version: u32,
    mark: u64,
    words: [u64; RIGPROOF_TICK_WORDS],
}

/// What lies in the words.
type Controller = Tick<f64, PathLaw<f64, AnyPath<f64, RIGPROOF_MOST_CORNERS>>>;

const _: () = assert!(
    size_of::<Controller>() <= 8 * RIGPROOF_TICK_WORDS
        && align_of::<Controller>() <= align_of::<u64>()
);

/// Makes a controller in `tick` that has seen nothing.
///
/// # Safety
/// `tick` must be null or point to `tick->size` bytes that may be written, `settings` be null or point to `settings->size` bytes that may be
/// read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_tick_create(
    tick: *mut RigproofTick,
    settings: *const RigproofTickSettings,
) -> RigproofTickStatus {
    if !is_usable(tick) || !is_usable(settings) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(tick) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size, and the caller's to write.
    unsafe { (&raw mut (*tick).mark).write(0) };
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(settings) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, and of this very size; every pattern of bits is one of its numbers.
    let settings = unsafe { &*settings };
    let Some(controller) = settings.controller() else {
        return RigproofTickStatus::BadSettings;
    };
    // SAFETY: the words are the caller's to write, large enough and aligned for a controller (asserted above).
    unsafe {
        (&raw mut (*tick).words)
            .cast::<Controller>()
            .write(controller);
        (&raw mut (*tick).mark).write(MARK);
    }
    RigproofTickStatus::Ok
}

/// The currents of one tick, and why. Bounded work, whatever is sensed. Whatever goes wrong, the command has no current, with one exception: where its
/// pointer or its size are wrong nothing can be written, and it keeps what it held. So a caller takes every status but `OK` for no current.
///
/// # Safety
/// Each pointer must be null or point to as many bytes as its size says; `tick` to a controller that was created (one that was not is told by its mark,
/// unless chance wrote the mark) and that no other thread uses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rigproof_tick_step(
    tick: *mut RigproofTick,
    sensed: *const RigproofTickSensed,
    command: *mut RigproofTickCommand,
) -> RigproofTickStatus {
    if !is_usable(command) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(command) } {
        // SAFETY: not null, aligned, and the caller's to write as far as its size says.
        unsafe { let_go(command) };
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size, and the caller's to write. Whatever goes wrong from here on, no brake has current.
    unsafe { command.write(RigproofTickCommand::none()) };
    if !is_usable(tick) || !is_usable(sensed) {
        return RigproofTickStatus::BadPointer;
    }
    // SAFETY: not null, aligned, and the caller's to read.
    if unsafe { !is_of_this_version(tick) || !is_of_this_version(sensed) } {
        return RigproofTickStatus::BadVersion;
    }
    // SAFETY: not null, aligned, of this very size, and the caller's to read.
    if unsafe { (&raw const (*tick).mark).read() } != MARK {
        return RigproofTickStatus::NotCreated;
    }
    // SAFETY: not null, aligned; every pattern of bits is one of its numbers.
    let sensed = unsafe { *sensed };
    // SAFETY: the mark says that `rigproof_tick_create` wrote a controller there, and nobody else uses it.
    let controller = unsafe { &mut *(&raw mut (*tick).words).cast::<Controller>() };
    let answer = controller.tick(&Sensed {
        number: sensed.number,
        counts: sensed.counts,
        tip_force_n: sensed.tip_force_n.into(),
    });
    // SAFETY: as above.
    unsafe { command.write(answer.into()) };
    RigproofTickStatus::Ok
}

/// Makes all numbers of a command of another version zero, whatever they mean, if its size is this version's: it must not keep the currents of a
/// tick before. Of another size, how much may be written is not known: a struct that was never filled in says any.
///
/// # Safety
/// `command` must be usable and point to as many bytes that may be written as its size says.
unsafe fn let_go(command: *mut RigproofTickCommand) {
    const HEAD: usize = size_of::<[u32; 2]>();
    const SIZE: usize = size_of::<RigproofTickCommand>();
    // SAFETY: the size is the first field of every version.
    let size = unsafe { command.cast::<u32>().read() };
    if size as usize == SIZE {
        // SAFETY: so many bytes are the caller's to write.
        unsafe { command.cast::<u8>().add(HEAD).write_bytes(0, SIZE - HEAD) };
    }
}

/// Whether a pointer is neither null nor at an address where what it points to cannot lie.
pub(crate) fn is_usable<T>(pointer: *const T) -> bool {
    !pointer.is_null() && pointer.is_aligned()
}

/// Whether a struct of C says that it is of this size and version.
///
/// # Safety
/// `pointer` must be usable and point to what begins with its size and version, 32 bits each, as every struct here does.
pub(crate) unsafe fn is_of_this_version<T: Versioned>(pointer: *const T) -> bool {
    // SAFETY: size and version are the first fields of every version and are read before any other.
    let [size, version] = unsafe { pointer.cast::<[u32; 2]>().read() };
    version == RIGPROOF_TICK_VERSION && size as usize == size_of::<T>()
}

/// A struct of C that begins with its size and version.
pub(crate) trait Versioned {}

impl Versioned for RigproofTick {}
impl Versioned for RigproofTickSettings {}
impl Versioned for RigproofTickSensed {}
impl Versioned for RigproofTickCommand {}

/// Without the standard library nothing catches a panic. None can happen (`impl/examples/no_panic.rs`); should one, the tick stops and
/// the amplifiers' own watchdog, which a rig needs, lets go (decision 0074).
#[cfg(all(not(feature = "std"), not(test)))]
#[panic_handler]
fn stop(_: &core::panic::PanicInfo) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
