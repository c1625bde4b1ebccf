//! Displacements of a beam by functions that the user gives (Ritz).

use super::eigen::{dense, first_dependent};
use super::gauss::{gauss_legendre, on_interval};
use super::integrals::{EntrySum, IntegrationPoint, add_stiffness, discs, mass_matrix, piece, stretch};
use super::line::{Bending, Cross, Shapes, Station};
use super::profile::Profile;
use super::reference::ReferenceLine;
use super::shape::{Elastic, MassIntegrals, Piece, Symmetric};
use super::shorten::shorten;
use super::spec::Ritz;
use crate::body::Build;
use crate::error::{Error, Result};
use crate::math::Taylor;
use crate::math::expression::{Expression, Number, Scope};
use crate::tolerances;

/// Panels at most: only functions that are not smooth, or not exact to rounding, need so many.
const RITZ_PANELS: usize = 64;

/// Largest number of functions: their integrals are computed for all pairs.
const MOST: usize = 200;
/// Gauss points on a panel.
const POINTS: usize = 12;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RitzKind {
    Bending,
    BendingZ,
    Axial,
    Torsion,
}

impl RitzKind {
    /// Key in the scene, and prefix of the coordinates' names.
    fn words(self) -> [&'static str; 2] {
        match self {
            RitzKind::Bending => ["bending", "bend"],
            RitzKind::BendingZ => ["bending_z", "bend_z"],
            RitzKind::Axial => ["axial", "stretch"],
            RitzKind::Torsion => ["torsion", "twist"],
        }
    }
}

#[derive(Clone, Debug)]
struct Function {
    kind: RitzKind,
    /// JSON path under `ritz`.
    path: String,
    value: Expression,
}

impl Function {
    fn at(&self, s: f64) -> Cross {
        let Taylor { x: f, d: slope, dd: curvature } = self.value.eval(&[Taylor::<f64>::time(s)]);
        let bending = Bending { w: f, slope, turn: slope, turn_rate: curvature };
        match self.kind {
            RitzKind::Bending => Cross::bending_y(bending),
            RitzKind::BendingZ => Cross::bending_z(bending),
            RitzKind::Axial => Cross::axial(f, slope),
            RitzKind::Torsion => Cross::torsion(f, slope),
        }
    }

    fn fault(&self, message: String) -> Error {
        Error::input(message).under(&self.path).under("ritz")
    }
}

/// The functions of a beam, one elastic coordinate each.
#[derive(Clone, Debug)]
pub struct Functions {
    line: ReferenceLine,
    functions: Vec<Function>,
    /// Factor of the mass block of the axial functions.
    axial_mass_factor: f64,
    profile: Profile,
    /// Number of panels of the integration.
    panels: usize,
    /// True without axial functions: the line then cannot stretch, and keeps its length as it bends.
    shortens: bool,
}

impl Shapes for Functions {
    fn reference(&self) -> &ReferenceLine {
        &self.line
    }
    fn at(&self, s: f64) -> Station {
        Station { dofs: self.dofs(), shapes: self.functions.iter().map(|f| f.at(s)).collect() }
    }
    fn breaks(&self) -> Vec<f64> {
        (0..=RITZ_PANELS).map(|k| self.line.length * k as f64 / RITZ_PANELS as f64).collect()
    }
    fn profile(&self) -> &Profile {
        &self.profile
    }
    fn shortens(&self) -> bool {
        self.shortens
    }
    fn inertia<const D: usize>(&self, s: f64) -> MassIntegrals<D> {
        self.sum(&self.samples([s, self.line.length], self.panels))
    }
}

impl Functions {
    /// # Errors
    /// Bad input: none at all, one that is no expression of x, or one that is not finite on the beam.
    pub fn of<const D: usize>(ritz: &Ritz, length: f64, profile: Profile, build: &Build<D>) -> Result<Self> {
        let given = [
            (RitzKind::Bending, &ritz.bending),
            (RitzKind::BendingZ, &ritz.bending_z),
            (RitzKind::Axial, &ritz.axial),
            (RitzKind::Torsion, &ritz.torsion),
        ];
        let mut functions = Vec::new();
        for (kind, numbers) in given {
            if D == 2 && matches!(kind, RitzKind::BendingZ | RitzKind::Torsion) && !numbers.is_empty() {
                return Err(Error::input("a beam in the plane bends along y only")
                    .under(kind.words()[0])
                    .under("ritz")
                    .hint("give \"bending\" and \"axial\""));
            }
            for (i, number) in numbers.iter().enumerate() {
                functions.push(function(kind, i, number, build).map_err(|error| error.under("ritz"))?);
            }
        }
        if functions.len() > MOST {
            return Err(Error::input(format!(
                "{} displacement functions, but at most {MOST} are possible",
                functions.len()
            ))
            .under("ritz")
            .hint("a few are enough for most beams; many are alike to round-off"));
        }
        if functions.is_empty() {
            return Err(Error::input("there is no displacement function")
                .under("ritz")
                .hint("give some as \"bending\" or \"axial\", such as \"sin(pi*x/l)\""));
        }
        let axial_mass_factor = match &ritz.axial_mass_factor {
            None => 1.0,
            Some(factor) => build.positive("axial_mass_factor", factor).map_err(|error| error.under("ritz"))?,
        };
        let functions = Functions {
            line: ReferenceLine::straight(length),
            functions,
            axial_mass_factor,
            panels: RITZ_PANELS,
            shortens: false,
            profile,
        };
        functions.check_finite()?;
        Ok(functions)
    }

    /// Checks that functions and slopes are finite on the whole beam, ends included, where joints may be.
    fn check_finite(&self) -> Result<()> {
        let places = places([0.0, self.line.length], RITZ_PANELS).map(|(s, _)| s).chain([0.0, self.line.length]);
        for s in places {
            for function in &self.functions {
                let Cross { displacement, rotation, strain, .. } = function.at(s);
                if displacement
                    .iter()
                    .chain(&rotation)
                    .chain(&strain)
                    // Its square is still a number; the exact value is infinite.
                    .any(|value| value.is_nan() || value.abs() > 1e150)
                {
                    return Err(function
                        .fault(format!("`{}` has no finite value and derivatives at x = {s}", function.value))
                        .hint("the function, its slope, and for bending its curvature must be finite along the beam"));
                }
            }
        }
        Ok(())
    }

    fn dofs(&self) -> Vec<usize> {
        (0..self.functions.len()).collect()
    }

    fn sum<const D: usize>(&self, samples: &[IntegrationPoint]) -> MassIntegrals<D> {
        let mut piece = piece(self.dofs(), samples);
        self.scale_axial(&mut piece);
        MassIntegrals { pieces: vec![piece], discs: discs::<D>(&self.dofs(), samples) }
    }

    fn samples(&self, ends: [f64; 2], panels: usize) -> Vec<IntegrationPoint> {
        places(ends, panels)
            .map(|(s, weight)| IntegrationPoint::new(&self.profile, &self.line, s, weight, self.at(s).shapes))
            .collect()
    }

    /// The beam without its damping; panels are doubled until the integrals no longer change.
    ///
    /// # Errors
    /// Bad input: functions that depend on one another, or move the beam as its frame does.
    pub fn elastic<const D: usize>(mut self, quartic: Option<f64>) -> Result<Elastic<D>> {
        let dofs = self.dofs();
        let integrals = |samples: &[IntegrationPoint]| {
            let mut stiffness = EntrySum::default();
            add_stiffness(&mut stiffness, &dofs, samples);
            (self.sum::<D>(samples), stiffness.finish())
        };
        let mut panels = 1;
        let mut samples = self.samples([0.0, self.line.length], panels);
        let mut last = integrals(&samples);
        while panels < RITZ_PANELS {
            panels *= 2;
            samples = self.samples([0.0, self.line.length], panels);
            let finer = integrals(&samples);
            let exact = agree(&diagonals(dofs.len(), &last), &diagonals(dofs.len(), &finer));
            last = finer;
            if exact {
                break;
            }
        }
        self.panels = panels;
        let (mut inertia, stiffness) = last;
        self.check_independent(&inertia, &stiffness)?;
        self.shortens = quartic == Some(1.0) && self.functions.iter().all(|function| function.kind != RitzKind::Axial);
        let quartic = quartic.filter(|_| !self.shortens);
        if self.shortens {
            inertia.pieces.iter_mut().for_each(|piece| shorten(&self, 0.0, piece));
        }
        let points = samples.chunks(1).filter_map(|point| Some((point, quartic?)));
        let stretches = points.scan(0.0, |start, (point, quartic)| {
            let next = stretch(quartic, *start, &dofs, point);
            *start = next.ends[1];
            Some(next)
        });
        let stretches = stretches.collect();
        let names = self.names();
        Ok(Elastic { names, inertia, stiffness, damping: Vec::new(), stretches, line: Some(Box::new(self)) })
    }

    fn names(&self) -> Vec<String> {
        let mut counts = [0; 4];
        let name = |function: &Function| {
            counts[function.kind as usize] += 1;
            format!("{}{}", function.kind.words()[1], counts[function.kind as usize])
        };
        self.functions.iter().map(name).collect()
    }

    /// Multiplies the mass block of the axial functions by their factor.
    fn scale_axial<const D: usize>(&self, piece: &mut Piece<D>) {
        let n = 1 + self.functions.len();
        let axial = |a: usize| a > 0 && self.functions[a - 1].kind == RitzKind::Axial;
        for a in (0..n).filter(|&a| axial(a)) {
            for b in (0..n).filter(|&b| axial(b)) {
                piece.products[a * n + b].iter_mut().flatten().for_each(|product| *product *= self.axial_mass_factor);
            }
        }
    }

    fn check_independent<const D: usize>(&self, inertia: &MassIntegrals<D>, stiffness: &Symmetric) -> Result<()> {
        let n = self.functions.len();
        let mass = dense(n, &mass_matrix(inertia));
        if let Some(i) = first_dependent(mass.as_ref(), tolerances::ROUND_OFF_OF_FACTORS) {
            let function = &self.functions[i];
            let what = if mass[(i, i)] == 0.0 { "is zero everywhere" } else { "is a sum of the functions before it" };
            return Err(function.fault(format!("`{}` {what}", function.value)).hint("remove it"));
        }
        if let Some(i) = first_dependent(dense(n, stiffness).as_ref(), tolerances::ROUND_OFF_OF_FACTORS) {
            let function = &self.functions[i];
            let with = if i == 0 { "" } else { ", with those before it," };
            return Err(function
                .fault(format!("`{}`{with} can move the beam without deforming it", function.value))
                .hint("the floating frame does that already: remove it"));
        }
        Ok(())
    }
}

/// Points of integration with their weights on equal panels of an interval.
fn places(ends: [f64; 2], panels: usize) -> impl Iterator<Item = (f64, f64)> {
    let [from, to] = ends;
    let rule = gauss_legendre(POINTS);
    let width = (to - from) / panels as f64;
    let panel = move |k: usize| [from + k as f64 * width, from + (k + 1) as f64 * width];
    (0..panels).flat_map(move |k| on_interval(&rule, panel(k)).collect::<Vec<_>>())
}

fn function<const D: usize>(kind: RitzKind, i: usize, number: &Number, build: &Build<D>) -> Result<Function> {
    let path = format!("{}[{i}]", kind.words()[0]);
    let names = Scope { parameters: build.parameters, variables: &["x"] };
    let value = number.expression(&names).map_err(|error| Error::from(error).under(&path))?;
    if build.parameters.get("x").is_some() && value.depends_on(0) {
        return Err(Error::input("`x` is the place along the beam here, but a parameter has this name too")
            .under(path)
            .hint("rename the parameter"));
    }
    Ok(Function { kind, path, value })
}

/// Diagonals of mass and stiffness matrix, interleaved.
fn diagonals<const D: usize>(n: usize, matrices: &(MassIntegrals<D>, Symmetric)) -> Vec<f64> {
    let (inertia, stiffness) = matrices;
    let mass = dense(n, &mass_matrix(inertia));
    let stiffness = dense(n, stiffness);
    (0..n).flat_map(|i| [mass[(i, i)], stiffness[(i, i)]]).collect()
}

fn agree(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerances::ROUND_OFF_OF_SOLUTIONS * b.abs())
}
