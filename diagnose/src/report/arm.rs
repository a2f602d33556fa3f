//! This file is the part of a report that goes through an arm joint by joint.

use serde::Serialize;

/// What an arm's model leaves over, joint by joint, and where the joints stand.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArmReport {
    /// The part that the errors are of: `held_out`, or `fitted` where nothing is held out.
    pub part: &'static str,
    /// Its joints from the base on; two rows for a joint whose motor is told from its link.
    pub joints: Vec<JointReport>,
    /// The time of the posture, s.
    pub posture_s: f64,
    /// The arm in that posture: the base, the origin of each joint, and the tip, in the frame of
    /// the base, m. Without a tip beyond the last joint its link's centre of mass is the end.
    pub line_m: Vec<[f64; 3]>,
}

impl ArmReport {
    /// The joint that has most of what the nominal model leaves over.
    pub fn worst(&self) -> Option<&JointReport> {
        let joints = self.joints.iter();
        joints.max_by(|a, b| a.share.total_cmp(&b.share))
    }
}

/// Whether a place is a joint or a part of it, as `elbow.motor` is of `elbow`.
pub fn is_of_joint(place: &str, joint: &str) -> bool {
    let rest = place.strip_prefix(joint);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// A joint of an arm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointReport {
    /// Its name.
    pub joint: &'static str,
    /// Unit of its effort.
    pub unit: String,
    /// Root mean square of the effort that inverse dynamics leaves over with the nominal model, all
    /// windows.
    pub before: f64,
    /// The same with the extended model.
    pub after: f64,
    /// Its share of the squared effort left over by the nominal model, among joints with its unit.
    pub share: f64,
    /// Its place in `line_m`.
    pub at: usize,
}
