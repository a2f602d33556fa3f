//! This file is the plane: vectors of two numbers.

use core::ops::{Add, Mul, Neg, Sub};

use crate::number::{Real, Scalar};

/// A vector or a point of the plane, x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<S> {
    /// Along the x axis.
    pub x: S,
    /// Along the y axis.
    pub y: S,
}

impl<S: Scalar> Vector<S> {
    /// The vector of two components.
    #[inline(always)]
    pub const fn new(x: S, y: S) -> Vector<S> {
        Vector { x, y }
    }

    /// The vector without length.
    #[inline(always)]
    pub fn zero() -> Vector<S> {
        Vector::new(S::zero(), S::zero())
    }

    /// x·x + y·y of two vectors.
    #[inline(always)]
    pub fn dot(self, other: Vector<S>) -> S {
        self.x * other.x + self.y * other.y
    }

    /// x·y − y·x: positive where `other` lies to the left.
    #[inline(always)]
    pub fn cross(self, other: Vector<S>) -> S {
        self.x * other.y - self.y * other.x
    }

    /// Turned by 90° to the left.
    #[inline(always)]
    pub fn left(self) -> Vector<S> {
        Vector::new(-self.y, self.x)
    }

    /// The square of the length.
    #[inline(always)]
    pub fn norm_squared(self) -> S {
        self.dot(self)
    }
}

impl<R: Real> Vector<R> {
    /// The length; squares must neither overflow nor vanish.
    pub fn norm(self) -> R {
        self.norm_squared().sqrt()
    }

    /// Whether both components are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl<S> From<[S; 2]> for Vector<S> {
    fn from([x, y]: [S; 2]) -> Vector<S> {
        Vector { x, y }
    }
}

impl<S> From<Vector<S>> for [S; 2] {
    fn from(vector: Vector<S>) -> [S; 2] {
        [vector.x, vector.y]
    }
}

impl<S: Scalar> Add for Vector<S> {
    type Output = Vector<S>;
    #[inline(always)]
    fn add(self, other: Vector<S>) -> Vector<S> {
        Vector::new(self.x + other.x, self.y + other.y)
    }
}

impl<S: Scalar> Sub for Vector<S> {
    type Output = Vector<S>;
    #[inline(always)]
    fn sub(self, other: Vector<S>) -> Vector<S> {
        Vector::new(self.x - other.x, self.y - other.y)
    }
}

impl<S: Scalar> Neg for Vector<S> {
    type Output = Vector<S>;
    #[inline(always)]
    fn neg(self) -> Vector<S> {
        Vector::new(-self.x, -self.y)
    }
}

impl<S: Scalar> Mul<S> for Vector<S> {
    type Output = Vector<S>;
    #[inline(always)]
    fn mul(self, factor: S) -> Vector<S> {
        Vector::new(self.x * factor, self.y * factor)
    }
}
