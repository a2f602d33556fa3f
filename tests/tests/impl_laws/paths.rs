//! This file says that every point lies to the rig's path as it lies to the reference's: as far, on the same side, beside the same direction.

use nalgebra::Vector2;
use rigproof_certify::differential::both::{reference_path, rig_path};
use rigproof_certify::differential::tick::PathKind;
use rigproof_impl::path::Path as _;

use crate::budget::assert_within_budget;
use crate::impl_laws::sample::Sampler;

/// Paths that are drawn; each is asked about as many points as [`POINTS`].
const PATHS: usize = 20_000;
const POINTS: usize = 12;
/// Feet that are further apart are two, m: they have to be as near.
const ONE_FOOT_M: f64 = 1e-5;
/// Places with two feet, as a share of all.
const GREATEST_SHARE_OF_TIES: f64 = 1e-5;

/// The path of another size.
fn scaled(kind: PathKind, by: f64) -> PathKind {
    let point = |[x, y]: [f64; 2]| [by * x, by * y];
    match kind {
        PathKind::Line(ends_m) => PathKind::Line(ends_m.map(point)),
        PathKind::Arc(centre_m, [radius_m, start_rad, sweep_rad]) => {
            PathKind::Arc(point(centre_m), [by * radius_m, start_rad, sweep_rad])
        }
        PathKind::Polyline(points_m, closed) => {
            PathKind::Polyline(points_m.into_iter().map(point).collect(), closed)
        }
        PathKind::Spline(points_m) => PathKind::Spline(points_m.into_iter().map(point).collect()),
    }
}

#[test]
fn a_point_lies_to_a_path_as_in_the_reference() {
    let mut sampler = Sampler::new(4_211);
    let (mut offsets_m, mut tangents, mut ties) = (Vec::new(), Vec::new(), 0);
    for number in 0..PATHS {
        // Splines are one path in 32 of those drawn, and have most to say.
        let kind = core::iter::repeat_with(|| sampler.plain().path)
            .find(|kind| number % 2 == 0 || matches!(kind, PathKind::Spline(_)))
            .unwrap();
        let size = [1.0, 11.3][number / 2 % 2];
        let kind = scaled(kind, size);
        let rig = rig_path::<f64>(&kind);
        let reference = reference_path(&kind).ok();
        assert_eq!(rig.is_some(), reference.is_some(), "{kind:?}");
        let (Some(rig), Some(reference)) = (rig, reference) else {
            continue;
        };
        for _ in 0..POINTS {
            let point_m = [0.03, 0.35].map(|middle| size * (middle + 0.71 * sampler.nudge()));
            let (own, expected) = (rig.nearest(point_m.into()), reference.nearest(point_m));
            let off_m = own.offset_m.abs() - expected.offset_m.abs();
            let tangent = Vector2::from(<[f64; 2]>::from(own.tangent));
            let left = Vector2::new(-tangent.y, tangent.x);
            let foot_m = Vector2::from(point_m) - left * own.offset_m;
            if (foot_m - expected.foot_m).norm() > ONE_FOOT_M {
                assert!(
                    off_m.abs() < 1e-12,
                    "{own:?} {expected:?} {point_m:?} {kind:?}"
                );
                ties += 1;
                continue;
            }
            offsets_m.push((own.offset_m - expected.offset_m).abs() / size);
            tangents.push((tangent - expected.tangent).norm());
        }
    }
    println!("{} places, {ties} with two feet", offsets_m.len());
    assert!(f64::from(ties) <= GREATEST_SHARE_OF_TIES * offsets_m.len() as f64);
    println!("offsets {}", crate::impl_laws::tally::quantiles(&offsets_m));
    println!("tangents {}", crate::impl_laws::tally::quantiles(&tangents));
    assert_within_budget("rig_path_offset", offsets_m);
    assert_within_budget("rig_path_tangent", tangents);
}
