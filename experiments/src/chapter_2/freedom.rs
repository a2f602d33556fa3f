//! This file measures how free a display is that is not to be felt: how far it gives way to a short push in each direction.

use core::f64::consts::PI;

use rigproof_model::ModelError;
use rigproof_model::displays::{Aim, Body, Device, Display, Now, Place, Plant, Rows};
use rigproof_model::rig::Rig;
use rigproof_spec::displays::{BODY, SCOOTER_MASS_KG};
use rigproof_spec::methods::SAMPLE_STEP_S;

use super::shown::Shown;
use crate::Error;

/// Where it is pushed, m, how hard, N, how long, in ticks, and in how many directions.
const TIP_M: [f64; 2] = [0.013, 0.36];
const PUSH_N: f64 = 6.0;
const TICKS: u32 = 100;
const DIRECTIONS: u32 = 24;

/// A device that resists nothing.
#[derive(Debug)]
struct Nothing;

impl Device for Nothing {
    fn decide(&mut self, _: &Aim<'_>, _: &Now<'_>) {}

    fn rows(&mut self, _: &Place, _: [f64; 2], _: f64) -> Rows {
        Rows::none()
    }
}

/// How far a display follows a push, over how far its body alone would: the least and the greatest share over the directions.
///
/// It starts at rest, Scooter with its castors along x.
pub fn freedom(shown: Shown) -> Result<[f64; 2], Error> {
    shares(shown).map_err(|error| Error::model("a push on a display", error))
}

fn shares(shown: Shown) -> Result<[f64; 2], ModelError> {
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    for k in 0..DIRECTIONS {
        let (sine, cosine) = libm::sincos(2.0 * PI * f64::from(k) / f64::from(DIRECTIONS));
        let push = [PUSH_N * cosine, PUSH_N * sine];
        let body = match shown {
            Shown::Scooter => Body::Plate {
                mass_kg: SCOOTER_MASS_KG,
            },
            Shown::Reed(layout) => Body::layout(layout),
            Shown::Padyc | Shown::Osaka | Shown::Pter => Body::layout(BODY),
        };
        let alone = Display::new(Plant::new(body, TIP_M, [0.0; 2])?, Nothing);
        let alone_m = along(moved_m(alone, push)?, push);
        let moved = match (shown, shown.display(TIP_M)?) {
            (Shown::Reed(layout), _) => {
                let mut rig = Rig::new(layout, TIP_M)?;
                for _ in 0..TICKS {
                    rig.step(push, [0.0; 4], SAMPLE_STEP_S)?;
                }
                from_start(rig.tip_m())
            }
            (_, Some(display)) => moved_m(display, push)?,
            (_, None) => [0.0; 2],
        };
        let share = along(moved, push) / alone_m;
        (least, greatest) = (least.min(share), greatest.max(share));
    }
    Ok([least, greatest])
}

fn moved_m(mut display: Display, push: [f64; 2]) -> Result<[f64; 2], ModelError> {
    for _ in 0..TICKS {
        display.tick(&Aim::Free, push, SAMPLE_STEP_S, |_| {})?;
    }
    Ok(from_start(display.plant().place().tip_m))
}

fn from_start([x, y]: [f64; 2]) -> [f64; 2] {
    let [from_x, from_y] = TIP_M;
    [x - from_x, y - from_y]
}

/// The part of a motion along a push, m.
fn along([x, y]: [f64; 2], [push_x, push_y]: [f64; 2]) -> f64 {
    (x * push_x + y * push_y) / PUSH_N
}
