//! This file opens a shared library and finds what a controller exports.

use std::path::Path;

use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};

use crate::axis::call as axis;
use crate::{
    RIGPROOF_CONTROLLER_VERSION, RigproofControllerCommanded, RigproofControllerSensed,
    RigproofControllerSettings,
};

/// What a controller exports.
pub struct Exports {
    /// `rigproof_controller_init`.
    pub init: unsafe extern "C" fn(*const RigproofControllerSettings) -> i32,
    /// `rigproof_controller_tick`.
    pub tick: unsafe extern "C" fn(
        *const RigproofControllerSensed,
        *mut RigproofControllerCommanded,
    ) -> i32,
    /// `rigproof_controller_shutdown`.
    pub shutdown: unsafe extern "C" fn(),
}

/// A library of either header.
pub enum Opened {
    /// Of the five-bar's.
    FiveBar(Exports),
    /// Of an axis's.
    Axis(axis::Exports),
}

/// The five-bar's header, as messages call it.
const HEADER: &str = "rigproof_controller.h";

impl Opened {
    /// Opens a library for as long as this process lives.
    ///
    /// # Errors
    /// What is wrong with it, and what to do.
    pub fn of(library: &Path) -> Result<Opened, String> {
        // SAFETY: its constructors run, which is what this process is for: nothing else is in it that they could harm.
        let opened = unsafe { Library::open(Some(library), RTLD_NOW | RTLD_LOCAL) };
        let opened = opened.map_err(|error| {
            // The loader's own words are the cause.
            let why = std::error::Error::source(&error)
                .map_or_else(|| error.to_string(), |cause| cause.to_string());
            format!(
                "it is no shared library that can be opened: {why}; build it with `-shared -fPIC` for this machine, with all that it calls"
            )
        })?;
        let found = match axis::Exports::of(&opened)? {
            Some(of_axis) => Opened::Axis(of_axis),
            None => Opened::FiveBar(Exports::of(&opened)?),
        };
        // It stays open: what was found in it is called to the end.
        std::mem::forget(opened);
        Ok(found)
    }
}

impl Exports {
    fn of(opened: &Library) -> Result<Exports, String> {
        // SAFETY: the header says this type of this name.
        let version: unsafe extern "C" fn() -> u32 =
            unsafe { export(opened, "rigproof_controller_version", HEADER) }?;
        // SAFETY: it takes nothing.
        let version = unsafe { version() };
        of_version(version, RIGPROOF_CONTROLLER_VERSION, HEADER)?;
        Ok(Exports {
            // SAFETY: as of this version.
            init: unsafe { export(opened, "rigproof_controller_init", HEADER) }?,
            // SAFETY: as of this version.
            tick: unsafe { export(opened, "rigproof_controller_tick", HEADER) }?,
            // SAFETY: as of this version.
            shutdown: unsafe { export(opened, "rigproof_controller_shutdown", HEADER) }?,
        })
    }
}

/// Refuses a library of another version of its header.
pub fn of_version(version: u32, own: u32, header: &str) -> Result<(), String> {
    match version == own {
        true => Ok(()),
        false => Err(format!(
            "it is of version {version} of {header}, this is version {own}: compile it with the header that is here"
        )),
    }
}

/// What a library exports under a name.
///
/// # Safety
/// It must be of type `T`, a pointer to a function.
pub unsafe fn export<T: Copy>(library: &Library, name: &str, header: &str) -> Result<T, String> {
    // SAFETY: the caller's.
    match unsafe { library.get::<T>(name) } {
        Ok(symbol) => Ok(*symbol),
        Err(_) => Err(format!(
            "it does not export `{name}`: write all four functions of {header} and let the linker keep them"
        )),
    }
}
