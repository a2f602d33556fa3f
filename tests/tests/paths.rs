//! This file says that the nearest point of every kind of path is the nearest, and that the tangent there is one.

use core::f64::consts::PI;

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use rigproof_model::ModelError;
use rigproof_model::control::path::{Arc, Line, Nearest, Path, Polyline, Spline};
use rigproof_tests::cases;

/// A path and densely spread points that lie on it.
type Sampled = (Box<dyn Path>, Vec<[f64; 2]>);

fn point() -> impl Strategy<Value = [f64; 2]> {
    [-0.47..0.53_f64, -0.31..0.67_f64]
}

fn corners(least: usize) -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(point(), least..7).prop_filter("neighbours lie apart", |corners| {
        let next = corners.iter().skip(1).chain(corners.first());
        corners
            .iter()
            .zip(next)
            .all(|(a, b)| distance(*a, *b) > 0.013)
    })
}

fn distance([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> f64 {
    libm::hypot(x_1 - x_2, y_1 - y_2)
}

fn between([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2], share: f64) -> [f64; 2] {
    [x_1 + share * (x_2 - x_1), y_1 + share * (y_2 - y_1)]
}

fn on_chain(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let pieces = corners.iter().zip(corners.iter().skip(1));
    pieces
        .flat_map(|(a, b)| (0..=100).map(|k| between(*a, *b, f64::from(k) / 100.0)))
        .collect()
}

/// Points of a centripetal Catmull-Rom curve by the pyramid of Barry and Goldman.
fn on_catmull_rom(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mirror = |a: [f64; 2], b: [f64; 2]| between(b, a, 2.0);
    let mut all = vec![mirror(points[0], points[1])];
    all.extend(points);
    all.push(mirror(points[points.len() - 1], points[points.len() - 2]));
    let mut found = Vec::new();
    for p in all.windows(4) {
        let mut t = [0.0; 4];
        for k in 1..4 {
            t[k] = t[k - 1] + libm::sqrt(distance(p[k - 1], p[k]));
        }
        for k in 0..=100 {
            let now = t[1] + (t[2] - t[1]) * f64::from(k) / 100.0;
            let mix = |a, b, from: f64, to: f64| between(a, b, (now - from) / (to - from));
            let a = [0, 1, 2].map(|i| mix(p[i], p[i + 1], t[i], t[i + 1]));
            let b = [0, 1].map(|i| mix(a[i], a[i + 1], t[i], t[i + 2]));
            found.push(mix(b[0], b[1], t[1], t[2]));
        }
    }
    found
}

fn line() -> impl Strategy<Value = Sampled> {
    corners(2).prop_map(|corners| {
        let on = on_chain(&corners[..2]);
        let line = Line::through(corners[0], corners[1]).unwrap();
        (Box::new(line) as Box<dyn Path>, on)
    })
}

fn arc() -> impl Strategy<Value = Sampled> {
    let sweep = prop_oneof![0.17..6.2_f64, Just(2.0 * PI)];
    (point(), 0.04..0.31_f64, -7.1..7.3_f64, sweep, any::<bool>()).prop_map(
        |(centre, radius, start, sweep, back)| {
            let sweep = if back { -sweep } else { sweep };
            let on = (0..=1000).map(|k| {
                let angle = start + sweep * f64::from(k) / 1000.0;
                let [x, y] = centre;
                [x + radius * libm::cos(angle), y + radius * libm::sin(angle)]
            });
            let arc = Arc::new(centre, radius, start, sweep).unwrap();
            (Box::new(arc) as Box<dyn Path>, on.collect())
        },
    )
}

fn polyline() -> impl Strategy<Value = Sampled> {
    (corners(3), any::<bool>()).prop_map(|(mut corners, closed)| {
        let path = if closed {
            Polyline::closed(&corners).unwrap()
        } else {
            Polyline::open(&corners).unwrap()
        };
        if closed {
            corners.push(corners[0]);
        }
        (Box::new(path) as Box<dyn Path>, on_chain(&corners))
    })
}

fn spline() -> impl Strategy<Value = Sampled> {
    corners(3).prop_map(|corners| {
        let on = on_catmull_rom(&corners);
        let spline = Spline::through(&corners).unwrap();
        (Box::new(spline) as Box<dyn Path>, on)
    })
}

fn check(path: &dyn Path, on: &[[f64; 2]], point: [f64; 2]) {
    let Nearest {
        foot_m,
        tangent,
        offset_m,
    } = path.nearest(point);
    let away = [point[0] - foot_m.x, point[1] - foot_m.y];
    let gap = libm::hypot(away[0], away[1]);
    assert!(
        (gap - offset_m.abs()).abs() < 1e-15,
        "the offset is the distance from the foot"
    );
    assert!((libm::hypot(tangent.x, tangent.y) - 1.0).abs() < 1e-14);
    let along = away[0] * tangent.x + away[1] * tangent.y;
    assert!(
        along.abs() < 1e-9,
        "the foot is {along} m along the tangent"
    );
    let left = tangent.x * away[1] - tangent.y * away[0];
    assert!((left - offset_m).abs() < 1e-9, "left is positive");
    for other in on {
        let theirs = distance(point, *other);
        assert!(
            theirs > offset_m.abs() - 1e-9,
            "{other:?} is nearer: {theirs} m, not {offset_m} m"
        );
    }
    // A point of the path is its own foot.
    for own in on.iter().step_by(37) {
        assert!(
            path.nearest(*own).offset_m.abs() < 1e-9,
            "{own:?} is not on the path"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(2_000),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_foot_on_a_line_is_the_nearest((path, on) in line(), point in point()) {
        check(&*path, &on, point);
    }

    #[test]
    fn the_foot_on_an_arc_is_the_nearest((path, on) in arc(), point in point()) {
        check(&*path, &on, point);
    }

    #[test]
    fn the_foot_on_a_polyline_is_the_nearest((path, on) in polyline(), point in point()) {
        check(&*path, &on, point);
    }

    #[test]
    fn the_foot_on_a_spline_is_the_nearest((path, on) in spline(), point in point()) {
        check(&*path, &on, point);
    }

    #[test]
    fn the_way_towards_a_path_ends_on_it((path, _) in spline(), point in point()) {
        let nearest = path.nearest(point);
        let towards = nearest.towards().unwrap() * nearest.distance_m();
        let arrived = path.nearest([point[0] + towards.x, point[1] + towards.y]);
        prop_assert!(arrived.distance_m() < 1e-9);
    }
}

#[test]
fn an_open_path_goes_on_straight_beyond_its_ends() {
    // A quarter circle of radius 0.2 m from (0.3, 0.1) to (0.1, 0.3), then straight on to the left.
    let arc = Arc::new([0.1, 0.1], 0.2, 0.0, PI / 2.0).unwrap();
    let beyond = arc.nearest([-0.37, 0.33]);
    assert!((beyond.offset_m + 0.03).abs() < 1e-15, "{beyond:?}");
    assert!((beyond.tangent.x + 1.0).abs() < 1e-15);
    let chain = Polyline::open(&[[0.0, 0.3], [0.1, 0.3], [0.1, 0.5]]).unwrap();
    assert!((chain.nearest([-0.7, 0.31]).offset_m - 0.01).abs() < 1e-15);
    assert!((chain.nearest([0.13, 0.9]).offset_m + 0.03).abs() < 1e-15);
}

#[test]
fn around_an_outer_corner_the_tangent_turns_with_the_point() {
    let chain = Polyline::open(&[[0.0, 0.3], [0.1, 0.3], [0.1, 0.5]]).unwrap();
    // From (0.1, 0.3) down and to the right, 3 and 4 cm: the outer side of a left turn is its right.
    let nearest = chain.nearest([0.13, 0.26]);
    assert!((nearest.offset_m + 0.05).abs() < 1e-15);
    assert!((nearest.tangent.x - 0.8).abs() < 1e-14 && (nearest.tangent.y - 0.6).abs() < 1e-14);
}

#[test]
fn a_closed_chain_has_its_inside_to_the_left_if_it_runs_counter_clockwise() {
    let square = Polyline::closed(&[[0.0, 0.2], [0.1, 0.2], [0.1, 0.3], [0.0, 0.3]]).unwrap();
    assert!((square.nearest([0.06, 0.29]).offset_m - 0.01).abs() < 1e-15);
    assert!((square.nearest([0.06, 0.33]).offset_m + 0.03).abs() < 1e-15);
    assert!((square.nearest([-0.03, 0.16]).offset_m + 0.05).abs() < 1e-15);
}

#[test]
fn paths_without_a_direction_are_named() {
    let same = [0.131, 0.277];
    let (apart, undefined) = ([0.31, 0.29], [0.31, f64::NAN]);
    assert!(matches!(
        Line::through(same, same),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Line::through(same, undefined),
        Err(ModelError::NotFinite { .. })
    ));
    assert!(matches!(
        Polyline::open(&[same, apart, apart]),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Polyline::open(&[same]),
        Err(ModelError::TooFew { count: 1, .. })
    ));
    assert!(matches!(
        Polyline::closed(&[same, apart]),
        Err(ModelError::TooFew { count: 2, .. })
    ));
    assert!(matches!(
        Spline::through(&[same, same, apart]),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Spline::through(&[same, apart]),
        Err(ModelError::TooFew { count: 2, .. })
    ));
    assert!(matches!(
        Spline::through(&[same, apart, undefined]),
        Err(ModelError::NotFinite { .. })
    ));
    assert!(matches!(
        Arc::new(same, 0.0, 0.3, 1.1),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Arc::new(same, -0.2, 0.3, 1.1),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Arc::new(same, 0.2, 0.3, 0.0),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        Arc::new(same, 0.2, 0.3, 6.4),
        Err(ModelError::SettingRange { .. })
    ));
    assert!(matches!(
        Arc::new(same, 0.2, f64::INFINITY, 1.1),
        Err(ModelError::NotFinite { .. })
    ));
    assert!(matches!(
        Arc::new(same, f64::NAN, 0.3, 1.1),
        Err(ModelError::NotFinite { .. })
    ));
    let text = Line::through(same, same).unwrap_err().to_string();
    assert_eq!(
        text,
        "the line is 0 m long; it must be at least 0.0000001 m: check the points and their unit"
    );
}
