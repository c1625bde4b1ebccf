//! A half space bounded by a coordinate plane, by which a vector along a line has a sign.

use super::Piece;
use crate::math::array::{Each, from_fn};

/// The vectors whose component `axis` has this sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    axis: usize,
    sign: f64,
}

impl Side {
    /// The side of the largest component of a vector.
    pub fn of(vector: &[f64; 3]) -> Self {
        let axis = (1..3).fold(0, |most, axis| if vector[axis].abs() > vector[most].abs() { axis } else { most });
        Side { axis, sign: if vector[axis] < 0.0 { -1.0 } else { 1.0 } }
    }

    /// The side that a piece stands for; none for piece zero.
    pub fn of_piece(piece: Piece) -> Option<Self> {
        let index = piece.checked_sub(1)?;
        Some(Side { axis: index as usize / 2, sign: if index % 2 == 0 { 1.0 } else { -1.0 } })
    }

    /// The piece that stands for it, 1 to 6.
    pub fn piece(self) -> Piece {
        1 + 2 * self.axis as Piece + Piece::from(self.sign < 0.0)
    }

    /// The other side.
    pub fn opposite(self) -> Self {
        Side { sign: -self.sign, ..self }
    }

    /// The component of a vector on this side, below zero for one on the other side.
    pub fn component(self, vector: &[f64; 3]) -> f64 {
        self.sign * vector[self.axis]
    }

    /// The unit vector along `vector` that is on this side; the axis where that is zero.
    pub fn along<const D: usize>(self, vector: [f64; D]) -> [f64; D] {
        let size = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        if size == 0.0 {
            return from_fn(|i| if i == self.axis { self.sign } else { 0.0 });
        }
        let sign = if self.sign * vector[self.axis] < 0.0 { -1.0 } else { 1.0 };
        vector.each(|x| sign * x / size)
    }
}

#[cfg(test)]
mod tests {
    use super::Side;

    #[test]
    fn a_side_is_the_one_of_its_piece() {
        for vector in [[2.0, 1.0, 0.0], [-2.0, 1.0, 0.5], [0.1, -0.3, 0.2], [0.0, 0.0, -1.0]] {
            let side = Side::of(&vector);
            assert_eq!(Side::of_piece(side.piece()), Some(side));
            assert!(side.component(&vector) > 0.0 && side.opposite().component(&vector) < 0.0);
            let along = side.along(vector);
            let opposite = side.along(vector.map(|x| -x));
            assert!(along == opposite && side.component(&along) > 0.0);
        }
        assert_eq!(Side::of_piece(0), None);
    }
}
