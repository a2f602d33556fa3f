//! This file says that the five-bar linkage moves as its geometry demands, beside the page and against other computations.

mod oracle;
mod round_trip;
