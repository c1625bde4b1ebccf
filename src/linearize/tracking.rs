//! Eigenvalues of one state after another, joined to branches.

use super::matching::{Node, is_clear, matching};
use super::slopes::Slope;
use super::{Complex, Kind, Matrix, Mode};

/// One eigenvalue followed through time or a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Class of the eigenvalue.
    pub kind: Kind,
    /// Time or parameter, and the eigenvalue there, 1/s.
    pub points: Vec<(f64, Complex<f64>)>,
    /// Derivative of the eigenvalue at each point, where it is known.
    pub slopes: Vec<Option<Complex<f64>>>,
}

impl Branch {
    /// Returns the branch with the points at some times or values only.
    pub(super) fn retain(self, is_kept: impl Fn(f64) -> bool) -> Self {
        let all = self.points.into_iter().zip(self.slopes).filter(|((at, _), _)| is_kept(*at));
        let (points, slopes) = all.unzip();
        Branch { kind: self.kind, points, slopes }
    }
}

/// The eigenvalues at a time or at a value of a parameter.
#[derive(Clone, Debug)]
pub struct LociPoint {
    /// Time, s, or value of the parameter.
    pub at: f64,
    /// Modes; empty where there is no linear model: branches go on after this gap.
    pub modes: Vec<Mode>,
    /// M there, the metric in which shapes are compared.
    pub mass: Matrix,
    /// Derivatives of the first modes; empty where they are not known.
    #[doc(hidden)]
    pub slopes: Vec<Slope>,
}

impl LociPoint {
    /// A time or value without a linear model.
    pub fn gap(at: f64) -> Self {
        LociPoint { at, modes: Vec::new(), mass: Matrix::zeros(0, 0), slopes: Vec::new() }
    }

    fn nodes(&self, kind: Kind) -> Vec<Node> {
        let slopes = self.slopes.iter().map(|slope| slope.derivative).chain(std::iter::repeat(None));
        let own = self.modes.iter().zip(slopes).filter(|(mode, _)| mode.kind == kind);
        own.map(|(mode, slope)| Node::new(mode, slope)).collect()
    }

    /// True if it is clear which physical mode of `next` belongs to which of these.
    pub fn leads_clearly_to(&self, next: &LociPoint) -> bool {
        let starts = self.nodes(Kind::Physical);
        let ends = next.nodes(Kind::Physical);
        is_clear(&starts.iter().collect::<Vec<_>>(), &ends, &next.mass)
    }
}

/// The end of a branch.
struct Thread {
    place: usize,
    at: f64,
    last: Node,
    /// The point before, if it was real or complex like the last.
    before: Option<(f64, Complex<f64>)>,
}

/// Returns the finite eigenvalues of `samples` as branches, in the order of their start: physical ones first, then
/// uncertain ones, and of a conjugate pair first the one with im > 0. Infinite eigenvalues are dropped.
///
/// From one sample to the next the modes of a kind are matched by the least sum of
///
/// ```text
/// (1 - MAC) + |lambda - p| / (|lambda| + |p|),   MAC = |x^H M y|^2 / ((x^H M x)(y^H M y))
/// ```
///
/// with p the extrapolation of the branch by its derivative, or by its last two values, of a pair that of its real part
/// and of the square of its imaginary part. The shapes x and y are changes along the velocity directions of the whole mechanism, so those of
/// neighbouring states compare: modes that cross keep their shapes, modes that veer exchange them slowly. Modal
/// assurance criterion: Allemang and Brown, Proc. 1st Int. Modal Analysis Conf. (1982) 110-116. A conjugate pair is
/// followed by a pair, or by two real eigenvalues, of which the larger belongs to the branch with im > 0. Where the
/// number of modes changes, branches start or end. In a gap every branch has a point that is not a number.
pub fn track(samples: &[LociPoint]) -> Vec<Branch> {
    let mut branches = Vec::new();
    let mut threads = Vec::new();
    for sample in samples {
        if sample.modes.is_empty() {
            let gap = Complex::new(f64::NAN, f64::NAN);
            threads.iter().for_each(|thread: &Thread| push(&mut branches, thread.place, (sample.at, gap), None));
            continue;
        }
        let before = std::mem::take(&mut threads);
        let mut rest = before;
        for known in [Kind::Physical, Kind::Uncertain, Kind::Spurious] {
            let (going, others) = rest.into_iter().partition(|thread| kind(&branches, thread) == known);
            threads.extend(go_on(going, sample, known, &mut branches));
            rest = others;
        }
    }
    // A branch that starts late comes after the others of its kind.
    branches.sort_by_key(|branch| branch.kind);
    branches
}

fn kind(branches: &[Branch], thread: &Thread) -> Kind {
    branches.get(thread.place).map_or(Kind::Physical, |branch| branch.kind)
}

fn push(branches: &mut [Branch], place: usize, point: (f64, Complex<f64>), slope: Option<Complex<f64>>) {
    if let Some(branch) = branches.get_mut(place) {
        branch.points.push(point);
        branch.slopes.push(slope);
    }
}

/// Continues the branches of a kind to one more sample, then starts new ones.
fn go_on(threads: Vec<Thread>, sample: &LociPoint, kind: Kind, branches: &mut Vec<Branch>) -> Vec<Thread> {
    let ends = sample.nodes(kind);
    let predicted: Vec<Complex<f64>> = threads.iter().map(|thread| thread.predicted(sample.at)).collect();
    let rows: Vec<&Node> = threads.iter().map(|thread| &thread.last).collect();
    let next = matching(&rows, &predicted, &ends, &sample.mass);
    let mut is_new = vec![true; ends.len()];
    let mut going = Vec::new();
    for (thread, end) in threads.iter().zip(next) {
        let Some(end) = end else { continue };
        is_new[end] = false;
        push(branches, thread.place, (sample.at, ends[end].value), ends[end].slope);
        going.push(thread.moved(sample.at, ends[end].clone()));
    }
    for end in upper_first(&ends).into_iter().filter(|&end| is_new[end]) {
        going.push(Thread { place: branches.len(), at: sample.at, last: ends[end].clone(), before: None });
        branches.push(Branch { kind, points: vec![(sample.at, ends[end].value)], slopes: vec![ends[end].slope] });
    }
    going
}

/// Places in their order, but of neighbours that are conjugate first the one with im > 0, and real ones from the
/// largest, as [`matching`] orders those that become a pair.
fn upper_first(nodes: &[Node]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    let mut i = 0;
    while i + 1 < nodes.len() {
        let is_pair = nodes[i].value.im != 0.0 && nodes[i].value == nodes[i + 1].value.conj();
        if is_pair && nodes[i].value.im < 0.0 {
            order.swap(i, i + 1);
        }
        i += if is_pair { 2 } else { 1 };
    }
    let places: Vec<usize> = (0..order.len()).filter(|&i| nodes[order[i]].value.im == 0.0).collect();
    let mut real: Vec<usize> = places.iter().map(|&place| order[place]).collect();
    real.sort_by(|&a, &b| nodes[b].value.re.total_cmp(&nodes[a].value.re));
    places.into_iter().zip(real).for_each(|(place, node)| order[place] = node);
    order
}

impl Thread {
    /// Returns the eigenvalue at a time or value by its derivative, or where that is not known by a straight line through
    /// the last two: of the value where it is real; else of its real part and of the square of its imaginary part, which
    /// is smooth also where a pair comes from the real axis.
    fn predicted(&self, at: f64) -> Complex<f64> {
        let value = self.last.value;
        let along = at - self.at;
        let [re, square] = match (self.last.slope, self.before) {
            (Some(slope), _) => [slope.re, 2.0 * value.im * slope.im],
            (None, Some((at_before, before))) => {
                let step = self.at - at_before;
                [(value.re - before.re) / step, (value.im * value.im - before.im * before.im) / step]
            }
            (None, None) => return value,
        };
        let im = (value.im * value.im + square * along).max(0.0).sqrt().copysign(value.im);
        let predicted = Complex::new(value.re + re * along, im);
        if predicted.re.is_finite() && predicted.im.is_finite() { predicted } else { value }
    }

    fn moved(&self, at: f64, end: Node) -> Thread {
        let value = self.last.value;
        let is_alike = (value.im == 0.0) == (end.value.im == 0.0);
        Thread { place: self.place, at, last: end, before: is_alike.then_some((self.at, value)) }
    }
}
