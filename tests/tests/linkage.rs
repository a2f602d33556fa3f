//! This file says that the five-bar linkage moves as its geometry demands, beside the page and against other computations.

mod chapter;
mod jacobian;
mod measured;
mod oracle;
mod page;
mod round_trip;
mod singular;
mod workspace;
