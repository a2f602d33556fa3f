//! The differential: what the reference decides beside the rig's code on the same sample, and which differences are ties (decisions 0071, 0147).

pub mod answer;
pub mod both;
pub mod idle;
pub mod level;
pub mod nudger;
pub mod permitted;
pub mod tick;
pub mod tie;
