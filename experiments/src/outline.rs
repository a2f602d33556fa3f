//! This file draws the workspace of a layout, as the background of its maps.

use rigproof_model::linkage::device::Device;
use rigproof_model::linkage::workspace::boundary;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::M_PER_CM;

use crate::{Curve, Error};

/// Side of the cells that the boundary is traced over, m; each of its points is exact.
const STEP_M: f64 = 0.004;

/// The boundary of a layout's workspace by tables 4.1 and 4.2, cm.
pub fn outline(layout: Layout) -> Result<Curve, Error> {
    let traced = boundary(&Device::layout(layout), STEP_M)
        .map_err(|error| Error::model("the boundary of the workspace", error))?;
    let (mut x_cm, mut y_cm) = (Vec::new(), Vec::new());
    for points in &traced.loops {
        for (point_m, _) in points.iter().chain(points.first()) {
            let [x, y] = point_m.map(cm);
            x_cm.push(x);
            y_cm.push(y);
        }
        x_cm.push(f64::NAN);
        y_cm.push(f64::NAN);
    }
    Ok(Curve::thin("workspace", &x_cm, &y_cm))
}

/// Centimetres of metres.
pub fn cm(length_m: f64) -> f64 {
    length_m / M_PER_CM
}

/// How the text calls a layout.
pub const fn name(layout: Layout) -> &'static str {
    match layout {
        Layout::ThreeBrake => "3-brake",
        Layout::FourBrake => "4-brake",
    }
}
