//! This file divides a static sweep into regimes: by command and the way it goes, and by speed.

use crate::cause::Place;
use crate::filter::ends;
use crate::locate::{Cell, Regimes};
use crate::plants::joint::run::JointRun;
use crate::weak::Windows;

impl JointRun {
    /// The regimes of a static sweep: by command and the way it goes, and by speed.
    pub(in crate::plants::joint) fn regimes_of_sweep(&self, windows: &Windows) -> Regimes {
        let none = Vec::new();
        let commands = self.current.as_ref().unwrap_or(&none);
        let [low, high] = ends(commands.iter().copied());
        let third = |k: usize| {
            let share = commands
                .get(k)
                .map_or(-1.0, |own| (own - low) / (high - low).max(1e-300));
            (3.0 * share).floor().clamp(-1.0, 2.0) as i32
        };
        let before = self.before();
        let way = |k: usize| -> f64 {
            let pair = commands.get(k).zip(before.get(k).copied().flatten());
            pair.map_or(0.0, |(now, before)| now - before)
        };
        let speed = |k: usize| self.motion.get(k).map_or(0.0, |now| now.speed);
        let [slowest, fastest] = ends(self.motion.iter().map(|now| now.speed.abs()));
        let cell = |label, rule: &dyn Fn(usize) -> bool| Cell {
            label,
            at: Place::Whole,
            member: windows.centres.iter().map(|row| rule(*row)).collect(),
        };
        let middle = 0.5 * (slowest + fastest);
        Regimes {
            output: "metered effort",
            counted: vec![true; windows.centres.len()],
            cells: vec![
                cell("lowest third of the command", &|k| third(k) == 0),
                cell("middle third of the command", &|k| third(k) == 1),
                cell("highest third of the command", &|k| third(k) == 2),
                cell("rows where the command rises", &|k| way(k) > 0.0),
                cell("rows where the command falls", &|k| way(k) < 0.0),
                cell("slower half of the speeds", &|k| speed(k).abs() < middle),
                cell("faster half of the speeds", &|k| speed(k).abs() > middle),
                cell("rows in the positive sense", &|k| speed(k) > 0.0),
                cell("rows in the negative sense", &|k| speed(k) < 0.0),
            ],
        }
    }

    /// The command of the row before each in the sweep, where it is here.
    fn before(&self) -> Vec<Option<f64>> {
        let (Some(rows), Some(commands)) = (&self.rows, &self.current) else {
            return Vec::new();
        };
        let mut of_row = vec![None; rows.iter().max().map_or(0, |last| last + 1)];
        for (row, command) in rows.iter().zip(commands) {
            if let Some(own) = of_row.get_mut(*row) {
                *own = Some(*command);
            }
        }
        let each = rows
            .iter()
            .map(|row| of_row.get(row.checked_sub(1)?).copied());
        each.map(Option::flatten).collect()
    }
}
