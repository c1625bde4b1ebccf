//! A beam's section in numbers.

use super::spec::{Elasticity, FlexibleBeam, Material, OneOrMany, SectionInertia, SectionShape, Stiffness, Theory};
use crate::body::Build;
use crate::error::{Error, Result};
use crate::math::expression::Number;
use std::f64::consts::PI;

/// Stiffness and inertia of a section with principal axes y and z; in the plane those about z and along y count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// N
    pub ea: f64,
    /// Shear along y and z with the shear factor, N; infinite where sections stay square to the line.
    pub ga: [f64; 2],
    /// Torsion, N m^2; zero in the plane.
    pub gj: f64,
    /// Bending about y and about z, N m^2.
    pub ei: [f64; 2],
    /// kg/m
    pub rho_a: f64,
    /// Moments of inertia per length about y and about z, kg m.
    pub rho_i: [f64; 2],
}

impl Section {
    /// Of extension, shear along y and z, twist and bending about y and z; zero for shear that there is none of.
    pub fn stiffness(&self) -> [f64; 6] {
        let [gy, gz] = self.ga.map(|ga| if ga.is_finite() { ga } else { 0.0 });
        [self.ea, gy, gz, self.gj, self.ei[0], self.ei[1]]
    }

    /// Resolves what the scene says.
    ///
    /// # Errors
    /// Bad input: a stiffness or mass that is zero or negative, or both forms given, or neither.
    pub fn of<const D: usize>(beam: &FlexibleBeam, build: &Build<D>) -> Result<Section> {
        let section = match (&beam.material, &beam.section, &beam.stiffness, &beam.inertia) {
            (Some(material), Some(shape), None, None) => {
                let Material { e, nu, g, rho } = material;
                from_shape((e, nu.as_ref(), g.as_ref()), Some(rho), shape, beam.theory, build)?
            }
            (None, None, Some(stiffness), Some(inertia)) => {
                with_inertia(from_numbers(stiffness, beam.theory, build)?, inertia, build)?
            }
            (None, None, None, None) => {
                return Err(Error::input("nothing says how stiff and heavy the beam is").hint(FORMS));
            }
            (Some(_), None, None, None) => return Err(Error::input("the key `section` is missing").hint(FORMS)),
            (None, Some(_), None, None) => return Err(Error::input("the key `material` is missing").hint(FORMS)),
            (None, None, Some(_), None) => return Err(Error::input("the key `inertia` is missing").hint(FORMS)),
            (None, None, None, Some(_)) => return Err(Error::input("the key `stiffness` is missing").hint(FORMS)),
            _ => return Err(Error::input("the section is given twice").hint(FORMS)),
        };
        Ok(section.of_theory(beam.theory))
    }

    /// The stiffness alone; the inertia is zero.
    ///
    /// # Errors
    /// Bad input: a stiffness that is zero or negative, or both forms given, or neither.
    pub fn massless<const D: usize>(
        material: Option<&Elasticity>,
        shape: Option<&SectionShape>,
        stiffness: Option<&Stiffness>,
        theory: Theory,
        build: &Build<D>,
    ) -> Result<Section> {
        let hint = "give \"material\" and \"section\", or \"stiffness\"";
        let section = match (material, shape, stiffness) {
            (Some(Elasticity { e, nu, g }), Some(shape), None) => {
                from_shape((e, nu.as_ref(), g.as_ref()), None, shape, theory, build)?
            }
            (None, None, Some(stiffness)) => from_numbers(stiffness, theory, build)?,
            (None, None, None) => return Err(Error::input("nothing says how stiff the beam is").hint(hint)),
            (Some(_), None, None) => return Err(Error::input("the key `section` is missing").hint(hint)),
            (None, Some(_), None) => return Err(Error::input("the key `material` is missing").hint(hint)),
            _ => return Err(Error::input("the section is given twice").hint(hint)),
        };
        Ok(section.of_theory(theory))
    }

    fn of_theory(self, theory: Theory) -> Section {
        match theory {
            Theory::EulerBernoulli => Section { ga: [f64::INFINITY; 2], ..self },
            Theory::Timoshenko => self,
        }
    }
}

/// Curvature of a relaxed beam, 1/m: twist, about y and about z.
///
/// # Errors
/// Bad input: not one number in the plane, three in space.
pub fn curvature<const D: usize>(given: Option<&OneOrMany>, build: &Build<D>) -> Result<[f64; 3]> {
    match given {
        None => Ok([0.0; 3]),
        Some(OneOrMany::One(number)) if D == 2 => Ok([0.0, 0.0, build.number("curvature", number)?]),
        Some(OneOrMany::Many(numbers)) if D == 3 => build.vector("curvature", numbers),
        Some(_) => {
            let expected = if D == 2 { "one number" } else { "three numbers: twist, about y and about z" };
            Err(Error::input(format!("expected {expected}")).under("curvature").hint("1/m, of the relaxed beam"))
        }
    }
}

const FORMS: &str = "give \"material\" and \"section\", or \"stiffness\" and \"inertia\"";

/// From (E, nu, G) and the density; without one the inertia is zero.
fn from_shape<const D: usize>(
    (e, nu, g): (&Number, Option<&Number>, Option<&Number>),
    rho: Option<&Number>,
    shape: &SectionShape,
    theory: Theory,
    build: &Build<D>,
) -> Result<Section> {
    let under = |error: Error| error.under("material");
    let e = build.positive("E", e).map_err(under)?;
    let rho = rho.map_or(Ok(0.0), |rho| build.positive("rho", rho)).map_err(under)?;
    let g = match (g, nu) {
        (Some(_), Some(_)) => {
            return Err(Error::input("both `G` and `nu` are given").under("material").hint("keep one of them"));
        }
        (Some(g), None) => Some(build.positive("G", g).map_err(under)?),
        (None, Some(nu)) => Some(e / (2.0 * (1.0 + poisson(nu, build).map_err(under)?))),
        (None, None) => None,
    };
    let Some(g) = g.or((D == 2 && theory == Theory::EulerBernoulli).then_some(0.0)) else {
        let what = if D == 3 { "torsion" } else { "shear" };
        return Err(Error::input(format!("{what} needs a shear modulus"))
            .under("material")
            .hint("give \"nu\" or \"G\""));
    };
    let shape = Shape::of(shape, build)?;
    Ok(Section {
        ea: e * shape.area,
        ga: [g * shape.area * shape.shear; 2],
        gj: if D == 3 { g * shape.torsion } else { 0.0 },
        ei: shape.second.map(|i| e * i),
        rho_a: rho * shape.area,
        rho_i: shape.second.map(|i| rho * i),
    })
}

fn poisson<const D: usize>(nu: &Number, build: &Build<D>) -> Result<f64> {
    let value = build.number("nu", nu)?;
    match value > -1.0 && value <= 0.5 {
        true => Ok(value),
        false => Err(Error::input(format!("nu is {value}, but lies between -1 and 0.5")).under("nu")),
    }
}

/// Geometry of a section.
struct Shape {
    area: f64,
    /// About y and z.
    second: [f64; 2],
    torsion: f64,
    /// Shear factor.
    shear: f64,
}

impl Shape {
    fn of<const D: usize>(shape: &SectionShape, build: &Build<D>) -> Result<Shape> {
        let under = |error: Error| error.under("section");
        match shape {
            SectionShape::Rectangle { height, width } => {
                let h = build.positive("rectangle.height", height).map_err(under)?;
                let b = build.positive("rectangle.width", width).map_err(under)?;
                let second = [h * b.powi(3) / 12.0, b * h.powi(3) / 12.0];
                Ok(Shape { area: h * b, second, torsion: torsion_of_rectangle(h, b), shear: 5.0 / 6.0 })
            }
            SectionShape::Circle { radius, inner_radius } => {
                let outer = build.positive("circle.radius", radius).map_err(under)?;
                let inner = inner_radius.as_ref().map_or(Ok(0.0), |r| build.not_negative("circle.inner_radius", r));
                let inner = inner.map_err(under)?;
                if inner >= outer {
                    return Err(Error::input("the inner radius is not smaller than the outer one")
                        .under("section.circle.inner_radius"));
                }
                let second = PI / 4.0 * (outer.powi(4) - inner.powi(4));
                let area = PI * (outer.powi(2) - inner.powi(2));
                // Cowper's factor for nu = 0 (J. Appl. Mech. 33 (1966) 335-340): 6/7 for a full circle, 1/2 for a thin tube.
                let ratio = (inner / outer).powi(2);
                let shear = 6.0 * (1.0 + ratio).powi(2) / (7.0 * (1.0 + ratio).powi(2) + 20.0 * ratio);
                Ok(Shape { area, second: [second; 2], torsion: 2.0 * second, shear })
            }
        }
    }
}

/// Saint-Venant's torsion constant of a rectangle: a b^3 (1/3 - 64/pi^5 (b/a) sum_odd tanh(n pi a/(2b))/n^5), a >= b
/// (Timoshenko and Goodier, Theory of Elasticity, section 109).
fn torsion_of_rectangle(h: f64, b: f64) -> f64 {
    let (long, short) = (h.max(b), h.min(b));
    let term = |n: f64| (n * PI * long / (2.0 * short)).tanh() / n.powi(5);
    let sum: f64 = (0..200).map(|k| term(f64::from(2 * k + 1))).sum();
    long * short.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * (short / long) * sum)
}

fn from_numbers<const D: usize>(stiffness: &Stiffness, theory: Theory, build: &Build<D>) -> Result<Section> {
    let under = |error: Error| error.under("stiffness");
    let missing = |key: &str, what: &str| {
        Error::input(format!("{what} needs `{key}`")).under("stiffness").hint(format!("give \"{key}\""))
    };
    let ea = build.positive("EA", &stiffness.ea).map_err(under)?;
    let ei = pair("EI", &stiffness.ei, build).map_err(under)?;
    let ga = match &stiffness.ga {
        Some(ga) => pair("GA", ga, build).map_err(under)?,
        None if theory == Theory::Timoshenko => return Err(missing("GA", "a Timoshenko beam")),
        None => [f64::INFINITY; 2],
    };
    let gj = match &stiffness.gj {
        Some(gj) => build.positive("GJ", gj).map_err(under)?,
        None if D == 3 => return Err(missing("GJ", "a beam in space")),
        None => 0.0,
    };
    Ok(Section { ea, ga, gj, ei, rho_a: 0.0, rho_i: [0.0; 2] })
}

fn with_inertia<const D: usize>(section: Section, inertia: &SectionInertia, build: &Build<D>) -> Result<Section> {
    let rho_a = build.positive("rhoA", &inertia.rho_a).map_err(|error| error.under("inertia"))?;
    let rho_i = match &inertia.rho_i {
        Some(rho_i) => pair("rhoI", rho_i, build).map_err(|error| error.under("inertia"))?,
        None if D == 3 => {
            return Err(Error::input("a beam in space turns about its own line, which needs `rhoI`")
                .under("inertia")
                .hint("give \"rhoI\", kg m"));
        }
        None => [0.0; 2],
    };
    Ok(Section { rho_a, rho_i, ..section })
}

/// [about y, about z], or along them.
fn pair<const D: usize>(field: &str, numbers: &OneOrMany, build: &Build<D>) -> Result<[f64; 2]> {
    match numbers {
        OneOrMany::One(number) => Ok([build.positive(field, number)?; 2]),
        OneOrMany::Many(numbers) if D == 3 && numbers.len() == 2 => {
            let one = |i: usize| build.positive(&format!("{field}[{i}]"), &numbers[i]);
            Ok([one(0)?, one(1)?])
        }
        OneOrMany::Many(numbers) => {
            let expected = if D == 3 { "one number or two" } else { "one number" };
            Err(Error::input(format!("expected {expected}, found {}", numbers.len())).under(field))
        }
    }
}
