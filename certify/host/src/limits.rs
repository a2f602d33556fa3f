//! This file takes from a process, before it opens a library, what a controller has no need of.

use rustix::io::Errno;
use rustix::process::{Resource, Rlimit, Signal, set_parent_process_death_signal, setrlimit};
use rustix::thread::set_no_new_privs;

/// Limits this process and all that it will start: memory and files, no dumps, no other rights, no calls to reach other processes or a network, and an end with the watch.
///
/// # Errors
/// What the system answers.
pub fn limit(memory_bytes: u64) -> Result<(), Errno> {
    let of = |most| Rlimit {
        current: Some(most),
        maximum: Some(most),
    };
    set_parent_process_death_signal(Some(Signal::KILL))?;
    set_no_new_privs(true)?;
    setrlimit(Resource::Core, of(0))?;
    setrlimit(Resource::Fsize, of(memory_bytes))?;
    setrlimit(Resource::As, of(memory_bytes))?;
    // A system without filters runs it all the same: the certificate says so.
    let _ = filter();
    Ok(())
}

/// Calls that no controller has a need of: to trace and reach into other processes, to use a network, to change what the system is made of.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
const REFUSED: [i64; 27] = [
    libc::SYS_ptrace,
    libc::SYS_process_vm_readv,
    libc::SYS_process_vm_writev,
    libc::SYS_pidfd_getfd,
    libc::SYS_pidfd_open,
    libc::SYS_kcmp,
    libc::SYS_socket,
    libc::SYS_connect,
    libc::SYS_bind,
    libc::SYS_bpf,
    libc::SYS_perf_event_open,
    libc::SYS_userfaultfd,
    libc::SYS_io_uring_setup,
    libc::SYS_mount,
    libc::SYS_umount2,
    libc::SYS_pivot_root,
    libc::SYS_chroot,
    libc::SYS_unshare,
    libc::SYS_setns,
    libc::SYS_keyctl,
    libc::SYS_add_key,
    libc::SYS_request_key,
    libc::SYS_init_module,
    libc::SYS_finit_module,
    libc::SYS_kexec_load,
    libc::SYS_open_by_handle_at,
    libc::SYS_quotactl,
];

/// Refuses these calls to this process and all that it will start.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
fn filter() -> Result<(), seccompiler::Error> {
    use seccompiler::{BpfProgram, SeccompAction, SeccompFilter, apply_filter};
    let rules = REFUSED.into_iter().map(|call| (call, Vec::new()));
    let filter = SeccompFilter::new(
        rules.collect(),
        SeccompAction::Allow,
        SeccompAction::Errno(libc::EPERM as u32),
        std::env::consts::ARCH.try_into()?,
    )?;
    apply_filter(&BpfProgram::try_from(filter)?)
}

/// The numbers of calls are not known here.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn filter() -> Result<(), Errno> {
    Err(Errno::NOSYS)
}
