//! Points of the unit cube: random, of a latin square, and Sobol's.

use crate::error::{Error, Result};
use crate::math::random::Random;
use std::str::FromStr;

/// How points fill the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filling {
    /// Each coordinate has one point in each of N equal intervals (McKay, Beckman, Conover 1979).
    Latin,
    /// Sobol's sequence with the direction numbers of Joe and Kuo (2008), shifted digit by digit.
    Sobol,
    /// Independent points.
    Random,
}

/// A filling with the number of its points, written `latin:100`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// How the points are placed.
    pub filling: Filling,
    /// Number of points.
    pub count: usize,
}

impl FromStr for Sample {
    type Err = Error;

    fn from_str(text: &str) -> Result<Sample> {
        let form = "write latin:N, sobol:N or random:N, as in latin:100";
        let (name, count) = text.split_once(':').ok_or_else(|| Error::input(form))?;
        let filling = match name.trim() {
            "latin" => Filling::Latin,
            "sobol" => Filling::Sobol,
            "random" => Filling::Random,
            other => return Err(Error::unknown("sample", other, ["latin", "sobol", "random"])),
        };
        match count.trim().parse() {
            Ok(count) if count > 0 => Ok(Sample { filling, count }),
            _ => Err(Error::input(format!("`{}` is no number of variants; {form}", count.trim()))),
        }
    }
}

impl Sample {
    /// Returns the points, each of `dimensions` coordinates from 0 to 1; the same for the same seed.
    ///
    /// # Errors
    /// More dimensions than there are direction numbers for.
    pub fn points(self, dimensions: usize, seed: u64) -> Result<Vec<Vec<f64>>> {
        let mut random = Random(seed);
        let columns: Vec<Vec<f64>> = match self.filling {
            Filling::Random => (0..dimensions).map(|_| (0..self.count).map(|_| unit(&mut random)).collect()).collect(),
            Filling::Latin => (0..dimensions).map(|_| latin(self.count, &mut random)).collect(),
            Filling::Sobol if dimensions > DIRECTIONS.len() + 1 => {
                let most = DIRECTIONS.len() + 1;
                let message = format!("sobol has direction numbers for {most} parameters, and {dimensions} are varied");
                return Err(Error::input(message).hint("take latin, which has no limit"));
            }
            Filling::Sobol => (0..dimensions).map(|d| sobol(d, self.count, random.bits() as u32)).collect(),
        };
        Ok((0..self.count).map(|row| columns.iter().map(|column| column[row]).collect()).collect())
    }
}

/// Returns a number from 0 up to, but without, 1.
fn unit(random: &mut Random) -> f64 {
    (random.bits() >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns one number in each of `count` equal intervals, in random order (Fisher and Yates).
fn latin(count: usize, random: &mut Random) -> Vec<f64> {
    let mut column: Vec<f64> = (0..count).map(|k| (k as f64 + unit(random)) / count as f64).collect();
    for k in (1..count).rev() {
        column.swap(k, (unit(random) * (k + 1) as f64) as usize);
    }
    column
}

/// Number of binary digits of a coordinate.
const DIGITS: u32 = 32;

/// Returns a coordinate of the first points of Sobol's sequence, in Gray's order, with a digital shift: point k + 1
/// differs from point k by the direction number of the lowest zero digit of k.
fn sobol(dimension: usize, count: usize, shift: u32) -> Vec<f64> {
    let directions = directions(dimension);
    let mut point = shift;
    let mut column = Vec::with_capacity(count);
    for k in 0..count as u32 {
        column.push(f64::from(point) / f64::from(DIGITS).exp2());
        point ^= directions[(k.trailing_ones() % DIGITS) as usize];
    }
    column
}

/// Returns the direction numbers v_i = m_i 2^(32-i): of the first coordinate m_i = 1, of the others by the recurrence
/// m_i = 2 a_1 m_{i-1} ^ 4 a_2 m_{i-2} ^ ... ^ 2^s m_{i-s} ^ m_{i-s} of a primitive polynomial of degree s.
fn directions(dimension: usize) -> Vec<u32> {
    let Some(&(a, first)) = dimension.checked_sub(1).and_then(|k| DIRECTIONS.get(k)) else {
        return (1..=DIGITS).map(|i| 1 << (DIGITS - i)).collect();
    };
    let degree = first.len();
    let mut v: Vec<u32> = first.iter().zip(1..).map(|(m, i)| m << (DIGITS - i)).collect();
    for i in degree..DIGITS as usize {
        let mut next = v[i - degree] ^ (v[i - degree] >> degree);
        for k in 1..degree {
            if (a >> (degree - 1 - k)) & 1 == 1 {
                next ^= v[i - k];
            }
        }
        v.push(next);
    }
    v
}

/// Coefficients a of the primitive polynomials as binary digits, and the first m_i: new-joe-kuo-6 of Joe and Kuo,
/// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30 (2008).
const DIRECTIONS: [(u32, &[u32]); 20] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str, dimensions: usize) -> Vec<Vec<f64>> {
        text.parse::<Sample>().unwrap().points(dimensions, 7).unwrap()
    }

    /// True if a coordinate has one point in each of N equal intervals.
    fn is_stratified(points: &[Vec<f64>], coordinate: usize) -> bool {
        let n = points.len();
        let mut places: Vec<usize> = points.iter().map(|point| (point[coordinate] * n as f64) as usize).collect();
        places.sort_unstable();
        places.into_iter().eq(0..n)
    }

    #[test]
    fn each_interval_of_a_latin_square_has_one_point() {
        let points = points("latin:37", 3);
        assert!((0..3).all(|d| is_stratified(&points, d)));
        assert!(points.iter().any(|point| point[0] > point[1]) && points.iter().any(|point| point[0] < point[1]));
    }

    /// The first points without a shift, as Bratley and Fox (1988) and SciPy have them.
    #[test]
    fn sobols_points_are_the_published_ones() {
        let known =
            [[0.0, 0.0], [0.5, 0.5], [0.75, 0.25], [0.25, 0.75], [0.375, 0.375], [0.875, 0.875], [0.625, 0.125]];
        let columns = [sobol(0, 7, 0), sobol(1, 7, 0)];
        assert!((0..7).all(|k| [columns[0][k], columns[1][k]] == known[k]), "{columns:?}");
    }

    /// Every coordinate, and of the first two every box of equal area with sides of powers of two: a (0, m, 2)-net.
    #[test]
    fn sobols_points_fill_the_cube_evenly() {
        let points = points("sobol:256", 21);
        assert!((0..21).all(|d| is_stratified(&points, d)));
        for power in 0..=8 {
            let sides = [f64::from(power).exp2(), f64::from(8 - power).exp2()];
            let boxed =
                |point: &Vec<f64>| (point[0] * sides[0]) as usize * sides[1] as usize + (point[1] * sides[1]) as usize;
            let mut boxes: Vec<usize> = points.iter().map(boxed).collect();
            boxes.sort_unstable();
            assert!(boxes.into_iter().eq(0..256), "{sides:?}");
        }
    }

    #[test]
    fn a_seed_repeats_its_points() {
        let sample: Sample = "random:50".parse().unwrap();
        assert_eq!(sample.points(2, 1), sample.points(2, 1));
        assert_ne!(sample.points(2, 1), sample.points(2, 2));
        assert!(points("random:50", 2).iter().flatten().all(|x| (0.0..1.0).contains(x)));
    }

    #[test]
    fn bad_samples_are_told() {
        let table = [
            ("latin", "write latin:N"),
            ("latin:0", "`0` is no number of variants"),
            ("latin:x", "`x` is no number of variants"),
            ("latn:9", "there is no sample `latn`"),
        ];
        for (text, message) in table {
            let error = text.parse::<Sample>().unwrap_err().to_string();
            assert!(error.starts_with(message), "{text}: {error}");
        }
        let error = "sobol:4".parse::<Sample>().unwrap().points(22, 1).unwrap_err().to_string();
        assert!(error.starts_with("sobol has direction numbers for 21 parameters, and 22 are varied"), "{error}");
    }
}
