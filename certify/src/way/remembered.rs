//! This file remembers how points lie to a spline: hand, controller, judge and metrics ask of the same points, and a spline takes most of a trial.

use std::cell::RefCell;
use std::rc::Rc;

use rigproof_impl::path::{AnyPath, Nearest, Path};
use rigproof_impl::vector::Vector;

use super::MOST_PIECES;
use crate::controller::Task;

/// Places of a memory, a power of two: a trial of 10 s asks of 20 000 points.
const PLACES_LOG_2: u32 = 15;
/// Memories that a thread keeps: of a trial's path, and of the way back.
const KEPT: usize = 2;

/// A path that is asked of a point once; what it answers is what the path answers, to the bit.
#[derive(Clone, Debug)]
pub struct Remembered {
    path: AnyPath<f64, MOST_PIECES>,
    memory: Option<Rc<Memory>>,
}

/// What one path answered.
#[derive(Debug)]
struct Memory {
    task: Task,
    places: RefCell<Vec<Option<Place>>>,
}

/// A point, by the bits of its coordinates, and the answer.
#[derive(Clone, Copy, Debug)]
struct Place {
    point: [u64; 2],
    nearest: Nearest<f64>,
}

thread_local! {
    /// The memories of the paths that were asked for last on this thread: all parts of a trial run on one.
    static MEMORIES: RefCell<Vec<Rc<Memory>>> = const { RefCell::new(Vec::new()) };
}

impl Remembered {
    /// The path of a task, which it follows from.
    pub fn new(path: AnyPath<f64, MOST_PIECES>, task: &Task) -> Remembered {
        let is_slow = matches!(path, AnyPath::Spline(_));
        Remembered {
            path,
            memory: is_slow.then(|| Memory::of(task)),
        }
    }
}

impl Memory {
    fn of(task: &Task) -> Rc<Memory> {
        MEMORIES.with_borrow_mut(|kept| {
            let memory = match kept.iter().position(|memory| memory.task == *task) {
                Some(place) => kept.remove(place),
                None => Rc::new(Memory {
                    task: task.clone(),
                    places: RefCell::new(vec![None; 1 << PLACES_LOG_2]),
                }),
            };
            kept.insert(0, Rc::clone(&memory));
            kept.truncate(KEPT);
            memory
        })
    }
}

impl Path<f64> for Remembered {
    fn nearest(&self, point_m: Vector<f64>) -> Nearest<f64> {
        let Some(memory) = &self.memory else {
            return self.path.nearest(point_m);
        };
        let point = [point_m.x.to_bits(), point_m.y.to_bits()];
        let [x, y] = point;
        // Fibonacci hashing: the upper bits of the product depend on all bits.
        let mixed = (x ^ y.rotate_left(32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mut places = memory.places.borrow_mut();
        let Some(place) = places.get_mut((mixed >> (64 - PLACES_LOG_2)) as usize) else {
            return self.path.nearest(point_m);
        };
        if let Some(known) = place
            && known.point == point
        {
            return known.nearest;
        }
        let nearest = self.path.nearest(point_m);
        *place = Some(Place { point, nearest });
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Draw;
    use crate::way::Way;

    #[test]
    fn what_is_remembered_is_what_the_path_answers() {
        let mut draw = Draw::new(3, 7);
        for _ in 0..3 {
            let mut point = || [draw.between(-0.13, 0.13), draw.between(0.28, 0.46)];
            let task = Task::Spline((0..4).map(|_| point()).collect());
            let (one, other) = (Way::new(&task).unwrap(), Way::new(&task).unwrap());
            let points: Vec<[f64; 2]> = (0..50_000).map(|_| point()).collect();
            let bits = |nearest: Nearest<f64>| {
                [nearest.tangent.x, nearest.tangent.y, nearest.offset_m].map(f64::to_bits)
            };
            for way in [&one, &other, &one] {
                for [x, y] in &points {
                    let point_m = Vector::new(*x, *y);
                    let fresh = bits(way.path.path.nearest(point_m));
                    assert_eq!(bits(way.path.nearest(point_m)), fresh);
                }
            }
            let (one, other) = (one.path.memory.unwrap(), other.path.memory.unwrap());
            assert!(Rc::ptr_eq(&one, &other));
        }
    }
}
