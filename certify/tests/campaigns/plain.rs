//! This file is a controller as a lab might write it: proportional control (§6.3), plain, with a place for every bug that is planted.

use rigproof_certify::controller::{Controller, Failure, Source, Task};
use rigproof_certify::way::Way;
use rigproof_impl::command::Command;
use rigproof_impl::current::CurrentGain;
use rigproof_impl::law::{Law, Situation};
use rigproof_impl::path::Path as _;
use rigproof_impl::select::{Candidate, best};
use rigproof_impl::tick::{Sensed, Settings, Tick};
use rigproof_impl::vector::Vector;
use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::influence_rank;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_spec::tables::brake_table;

/// A bug of the law itself; those of what is around it are in `planted`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bug {
    None,
    /// The force of brake E is taken with the wrong sign.
    SignOfE,
    /// The blend of 90° is computed in degrees.
    Degrees,
    /// A force is asked of a brake as if it were a torque.
    NotNormalised,
    /// It locks when the hand pushes towards the path.
    WrongLock,
    /// The gain has no limit, and the current neither.
    Unsaturated,
}

pub struct Plain {
    way: Way,
    layout: Layout,
    gain_n_s_per_m: f64,
    bug: Bug,
}

impl Plain {
    fn desired(&self, now: &Situation<f64>) -> (Vector<f64>, Option<Vector<f64>>) {
        let nearest = self.way.path.nearest(now.linkage.tip_m);
        let along = if nearest.tangent.dot(now.tip_force_n) < 0.0 {
            -nearest.tangent
        } else {
            nearest.tangent
        };
        let share = (nearest.distance_m() / 0.05).min(1.0);
        let quarter = match self.bug {
            Bug::Degrees => 90.0,
            _ => core::f64::consts::FRAC_PI_2,
        };
        let direction = nearest.towards().map_or(along, |towards| {
            let (sine, cosine) = libm::sincos(quarter * share);
            along * cosine + towards * sine
        });
        (direction, nearest.towards())
    }

    fn candidate(
        &self,
        joint: Joint,
        now: &Situation<f64>,
        direction: Vector<f64>,
    ) -> Option<Candidate<f64>> {
        let row = now.rows[joint as usize];
        let velocity = now.tip_velocity_m_s;
        let rate = row.dot(velocity);
        if !self.layout.brakes().contains(&joint)
            || rate.abs() < 1e-4 * row.norm() * velocity.norm()
        {
            return None;
        }
        let mut force = row * -rate.signum();
        if self.bug == Bug::SignOfE && joint == Joint::E {
            force = -force;
        }
        let sign = |component: f64, speed: f64| match component * component {
            small if small < 1e-18 * row.norm_squared() => 0,
            _ if (component > 0.0) == (speed >= 0.0) => 1,
            _ => -1,
        };
        let (along, across) = (direction.dot(force), direction.cross(force));
        let influence = [
            sign(along, direction.dot(velocity)),
            sign(across, direction.cross(velocity)),
        ];
        influence_rank(influence).map(|rank| Candidate {
            rank,
            component: along,
            length_squared: row.norm_squared(),
        })
    }

    fn lock(&self) -> Command<f64> {
        let braked = |joint| f64::from(u8::from(self.layout.brakes().contains(&joint)));
        Command {
            currents_a: Joint::ALL.map(braked),
            reason: Reason::LockedPushedAway,
        }
    }

    fn current_a(&self, joint: Joint, row: Vector<f64>, force_n: f64) -> f64 {
        let gain = CurrentGain::<f64>::new(&brake_table(joint));
        match self.bug {
            Bug::NotNormalised => gain.current_a(force_n),
            Bug::Unsaturated => force_n / row.norm() / 5.6,
            _ => gain.current_a(force_n / row.norm()),
        }
    }
}

impl Law<f64> for Plain {
    fn command(&mut self, now: &Situation<f64>) -> Command<f64> {
        let (direction, towards) = self.desired(now);
        let velocity = now.tip_velocity_m_s;
        let pushed = towards.map_or(0.0, |towards| towards.dot(now.tip_force_n));
        let pushes_away = match self.bug {
            Bug::WrongLock => pushed > 0.0,
            _ => pushed < 0.0,
        };
        if direction.dot(velocity) < 0.0 {
            return self.lock();
        }
        let unwanted = direction.cross(velocity);
        let candidate = |joint| match unwanted == 0.0 {
            true => None,
            false => self.candidate(joint, now, direction),
        };
        let Some(joint) = best(Joint::ALL.map(candidate)) else {
            return if pushes_away {
                self.lock()
            } else {
                Command::none(Reason::NoneHelps)
            };
        };
        let wanted_n = self.gain_n_s_per_m * unwanted.abs();
        let force_n = match self.bug {
            Bug::Unsaturated => wanted_n,
            _ => wanted_n.min(greatest_desired_force_n(self.layout)),
        };
        let mut command = Command::none(Reason::Chosen(joint));
        let row = now.rows[joint as usize];
        command.currents_a[joint as usize] = self.current_a(joint, row, force_n);
        command
    }

    fn actuation(&self) -> Option<&rigproof_impl::actuation::Actuation<f64>> {
        None
    }
}

/// The law with a bug, behind the rig's guard; where the guard would refuse what it asks for, without it.
pub fn source(bug: Bug) -> impl Source {
    move |settings: &Settings, task: &Task| -> Result<Box<dyn Controller>, Failure> {
        let law = Plain {
            way: Way::new(task).ok_or(Failure::Refused("the path".to_owned()))?,
            layout: settings.layout,
            gain_n_s_per_m: 500.0,
            bug,
        };
        if bug == Bug::Unsaturated {
            let eye = Eye::default();
            let tick = Tick::new(
                settings,
                Watched {
                    law,
                    eye: eye.clone(),
                },
            );
            let tick = tick.ok_or(Failure::Refused("the settings".to_owned()))?;
            return Ok(Box::new(Unguarded { tick, eye }));
        }
        let tick = Tick::new(settings, law);
        Ok(Box::new(
            tick.ok_or(Failure::Refused("the settings".to_owned()))?,
        ))
    }
}

type Eye = std::rc::Rc<std::cell::Cell<[f64; 4]>>;

/// A law whose wish is seen before the guard sees it.
struct Watched {
    law: Plain,
    eye: Eye,
}

impl Law<f64> for Watched {
    fn command(&mut self, now: &Situation<f64>) -> Command<f64> {
        let command = self.law.command(now);
        self.eye.set(command.currents_a);
        command
    }

    fn actuation(&self) -> Option<&rigproof_impl::actuation::Actuation<f64>> {
        None
    }
}

/// A controller that answers what its law asks for.
struct Unguarded {
    tick: Tick<f64, Watched>,
    eye: Eye,
}

impl Controller for Unguarded {
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        self.eye.set([0.0; 4]);
        self.tick.tick(sensed);
        Ok(self.eye.get())
    }
}
