//! This file opens a shared library and finds what a controller exports.

use std::path::Path;

use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};

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

impl Exports {
    /// Opens a library for as long as this process lives.
    ///
    /// # Errors
    /// What is wrong with it, and what to do.
    pub fn of(library: &Path) -> Result<Exports, String> {
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
        // SAFETY: the header says this type of this name.
        let version: unsafe extern "C" fn() -> u32 =
            unsafe { export(&opened, "rigproof_controller_version") }?;
        // SAFETY: it takes nothing.
        let version = unsafe { version() };
        if version != RIGPROOF_CONTROLLER_VERSION {
            return Err(format!(
                "it is of version {version} of rigproof_controller.h, this is version {RIGPROOF_CONTROLLER_VERSION}: compile it with the header that is here"
            ));
        }
        let exports = Exports {
            // SAFETY: as of this version.
            init: unsafe { export(&opened, "rigproof_controller_init") }?,
            // SAFETY: as of this version.
            tick: unsafe { export(&opened, "rigproof_controller_tick") }?,
            // SAFETY: as of this version.
            shutdown: unsafe { export(&opened, "rigproof_controller_shutdown") }?,
        };
        // It stays open: what was found in it is called to the end.
        std::mem::forget(opened);
        Ok(exports)
    }
}

/// What a library exports under a name.
///
/// # Safety
/// It must be of type `T`, a pointer to a function.
unsafe fn export<T: Copy>(library: &Library, name: &str) -> Result<T, String> {
    // SAFETY: the caller's.
    match unsafe { library.get::<T>(name) } {
        Ok(symbol) => Ok(*symbol),
        Err(_) => Err(format!(
            "it does not export `{name}`: write all four functions of rigproof_controller.h and let the linker keep them"
        )),
    }
}
