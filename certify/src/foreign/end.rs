//! This file says how a controller's process ended, in words for a person at a laboratory.

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// With an exit code.
    Code(i32),
    /// By a signal.
    Signal(i32),
    /// It was ended, since nobody was connected to it any more.
    Lost,
}

/// The exit code of a host that lost its connection.
pub const LOST: i32 = 120;

impl End {
    /// What a person at the lab is told; `memory_bytes` is what it was given.
    pub fn words(self, memory_bytes: u64) -> String {
        let limit = format!("the limit of {} MB", memory_bytes >> 20);
        match self {
            End::Lost | End::Code(LOST) => {
                "it closed the connection of its process: a controller must leave descriptors alone that it did not open"
                    .to_owned()
            }
            End::Code(code) => format!("it called exit with code {code}"),
            End::Signal(4) => "signal 4 (SIGILL): it ran what is no instruction of this processor".to_owned(),
            End::Signal(6) => format!("signal 6 (SIGABRT): it called abort, or its run time did, as when memory is short at {limit}"),
            End::Signal(7) => "signal 7 (SIGBUS): it used an address that cannot be".to_owned(),
            End::Signal(8) => "signal 8 (SIGFPE): it divided an integer by zero".to_owned(),
            End::Signal(9) => "signal 9 (SIGKILL): it was killed, by itself or by a system short of memory".to_owned(),
            End::Signal(11) => format!(
                "signal 11 (SIGSEGV): it used an address that is not its own, such as a null pointer or what an allocation beyond {limit} gave"
            ),
            End::Signal(25) => format!("signal 25 (SIGXFSZ): it wrote a file larger than {limit}"),
            End::Signal(number) => format!("signal {number}"),
        }
    }
}
