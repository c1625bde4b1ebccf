//! Reads a beam's section from a scene.

use super::profile::{Laws, Profile, ProfileLaw, SectionKind};
use super::section::{Matter, Section};
use super::spec::{Elasticity, FlexibleBeam, Material, OneOrMany, SectionInertia, SectionShape, Stiffness, Theory};
use crate::body::Build;
use crate::error::{Error, Result, Warning, short};
use crate::math::expression::{Number, Scope};

/// Young's modulus of a solid that is smaller is probably in another unit. Unit: `[Pa]`. Why: the softest rubber has
/// 1e5 to 1e6. Test: `a_modulus_in_another_unit_is_said`.
const SOFTEST_SOLID: f64 = 1e5;

const FORMS: &str = "give \"material\" and \"section\", or \"stiffness\" and \"inertia\"";

impl Profile {
    /// The profile of a beam of the given length, m.
    ///
    /// # Errors
    /// Bad input: a stiffness or mass that is not above zero somewhere on the beam, or both forms given, or neither.
    pub fn of<const D: usize>(beam: &FlexibleBeam, length: f64, build: &Build<D>) -> Result<Profile> {
        let read = SectionReader { build, variables: &["s"] };
        let (make, laws) = match (&beam.material, &beam.section, &beam.stiffness, &beam.inertia) {
            (Some(material), Some(shape), None, None) => {
                let Material { e, nu, g, rho } = material;
                read.shape(e, nu.as_ref(), g.as_ref(), Some(rho), shape, beam.theory)?
            }
            (None, None, Some(stiffness), Some(inertia)) => read.numbers(stiffness, Some(inertia), beam.theory)?,
            (None, None, None, None) => {
                return Err(Error::input("nothing says how stiff and heavy the beam is").hint(FORMS));
            }
            (Some(_), None, None, None) => return Err(Error::input("the key `section` is missing").hint(FORMS)),
            (None, Some(_), None, None) => return Err(Error::input("the key `material` is missing").hint(FORMS)),
            (None, None, Some(_), None) => return Err(Error::input("the key `inertia` is missing").hint(FORMS)),
            (None, None, None, Some(_)) => return Err(Error::input("the key `stiffness` is missing").hint(FORMS)),
            _ => return Err(Error::input("the section is given twice").hint(FORMS)),
        };
        let rotary = beam.rotary_inertia.unwrap_or(beam.theory == Theory::Timoshenko);
        Profile::new(Laws { make, laws, theory: beam.theory, dimension: D }, length, rotary)
    }
}

impl Section {
    /// The section of a massless beam: stiffness constant along the beam, no inertia.
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
        let read = SectionReader { build, variables: &[] };
        let (make, laws) = match (material, shape, stiffness) {
            (Some(Elasticity { e, nu, g }), Some(shape), None) => {
                read.shape(e, nu.as_ref(), g.as_ref(), None, shape, theory)?
            }
            (None, None, Some(stiffness)) => read.numbers(stiffness, None, theory)?,
            (None, None, None) => return Err(Error::input("nothing says how stiff the beam is").hint(hint)),
            (Some(_), None, None) => return Err(Error::input("the key `section` is missing").hint(hint)),
            (None, Some(_), None) => return Err(Error::input("the key `material` is missing").hint(hint)),
            _ => return Err(Error::input("the section is given twice").hint(hint)),
        };
        Profile::new(Laws { make, laws, theory, dimension: D }, 0.0, false).map(|profile| profile.at(0.0))
    }
}

struct SectionReader<'a, const D: usize> {
    build: &'a Build<'a, D>,
    /// Variables that the numbers may depend on in addition to parameters.
    variables: &'a [&'a str],
}

impl<const D: usize> SectionReader<'_, D> {
    /// Laws of a section given by its form, (E, nu, G) and density; without density the inertia is zero.
    fn shape(
        &self,
        e: &Number,
        nu: Option<&Number>,
        g: Option<&Number>,
        rho: Option<&Number>,
        shape: &SectionShape,
        theory: Theory,
    ) -> Result<(SectionKind, Vec<ProfileLaw>)> {
        let build = self.build;
        let under = |error: Error| error.under("material");
        let e = build.positive("E", e).map_err(under)?;
        self.doubt_modulus(e);
        let rho = rho.map_or(Ok(0.0), |rho| build.positive("rho", rho)).map_err(under)?;
        let g = match (g, nu) {
            (Some(_), Some(_)) => {
                return Err(Error::input("both `G` and `nu` are given").under("material").hint("keep one of them"));
            }
            (Some(g), None) => build.positive("G", g).map_err(under)?,
            (None, Some(nu)) => e / (2.0 * (1.0 + poisson(nu, build).map_err(under)?)),
            // In the plane, a beam whose sections stay normal to it neither shears nor twists.
            (None, None) if D == 2 && theory == Theory::EulerBernoulli => 0.0,
            (None, None) => {
                let what = if D == 3 { "torsion" } else { "shear" };
                return Err(Error::input(format!("{what} needs a shear modulus"))
                    .under("material")
                    .hint("give \"nu\" or \"G\""));
            }
        };
        let matter = Matter { e, g, rho };
        match shape {
            SectionShape::Rectangle { height, width } => {
                let height = self.positive("section.rectangle.height", height)?;
                Ok((SectionKind::Rectangle(matter), vec![height, self.positive("section.rectangle.width", width)?]))
            }
            SectionShape::Circle { radius, inner_radius } => {
                let outer = self.positive("section.circle.radius", radius)?;
                let inner = inner_radius.as_ref().map(|r| self.law("section.circle.inner_radius", r, true));
                Ok((SectionKind::Circle(matter), vec![outer, inner.unwrap_or(Ok(ProfileLaw::constant(0.0)))?]))
            }
        }
    }

    /// Warns of a modulus that is probably in MPa or GPa.
    fn doubt_modulus(&self, e: f64) {
        if e < SOFTEST_SOLID {
            let modulus = short(e);
            let text = format!("`E` is {modulus} Pa, and the softest rubber has {:e} Pa", SOFTEST_SOLID);
            let hint = format!("for {modulus} GPa write {modulus}e9, for {modulus} MPa (N/mm^2) {modulus}e6");
            self.build.switches.borrow_mut().doubts.push(Warning::new(text, hint));
        }
    }

    /// Laws of a section given by its stiffness and inertia, in the order of [`SectionKind::Numbers`].
    fn numbers(
        &self,
        stiffness: &Stiffness,
        inertia: Option<&SectionInertia>,
        theory: Theory,
    ) -> Result<(SectionKind, Vec<ProfileLaw>)> {
        let missing = |key: &str, what: &str| {
            Error::input(format!("{what} needs `{key}`")).under("stiffness").hint(format!("give \"{key}\""))
        };
        let ea = self.positive("stiffness.EA", &stiffness.ea)?;
        let ei = self.pair("stiffness.EI", &stiffness.ei)?;
        let ga = match &stiffness.ga {
            Some(ga) => self.pair("stiffness.GA", ga)?,
            None if theory == Theory::Timoshenko => return Err(missing("GA", "a Timoshenko beam")),
            None => [f64::INFINITY; 2].map(ProfileLaw::constant),
        };
        let gj = match &stiffness.gj {
            Some(gj) => self.positive("stiffness.GJ", gj)?,
            None if D == 3 => return Err(missing("GJ", "a beam in space")),
            None => ProfileLaw::constant(0.0),
        };
        let mass = inertia.map_or(Ok([0.0; 3].map(ProfileLaw::constant)), |inertia| self.inertia(inertia))?;
        Ok((SectionKind::Numbers, [ea].into_iter().chain(ga).chain([gj]).chain(ei).chain(mass).collect()))
    }

    fn inertia(&self, inertia: &SectionInertia) -> Result<[ProfileLaw; 3]> {
        let rho_a = self.positive("inertia.rhoA", &inertia.rho_a)?;
        let [y, z] = match &inertia.rho_i {
            Some(rho_i) => self.pair("inertia.rhoI", rho_i)?,
            None if D == 3 => {
                return Err(Error::input("a beam in space turns about its own line, which needs `rhoI`")
                    .under("inertia")
                    .hint("give \"rhoI\", kg m"));
            }
            None => [0.0; 2].map(ProfileLaw::constant),
        };
        Ok([rho_a, y, z])
    }

    /// Laws for two directions, [about y, about z] or [along y, along z].
    fn pair(&self, path: &str, numbers: &OneOrMany) -> Result<[ProfileLaw; 2]> {
        match numbers {
            OneOrMany::One(number) => self.positive(path, number).map(|law| [law.clone(), law]),
            OneOrMany::Many(numbers) if D == 3 && numbers.len() == 2 => {
                let one = |i: usize| self.positive(&format!("{path}[{i}]"), &numbers[i]);
                Ok([one(0)?, one(1)?])
            }
            OneOrMany::Many(numbers) => {
                let expected = if D == 3 { "one number or two" } else { "one number" };
                Err(Error::input(format!("expected {expected}, found {}", numbers.len())).under(path))
            }
        }
    }

    fn positive(&self, path: &str, number: &Number) -> Result<ProfileLaw> {
        self.law(path, number, false)
    }

    fn law(&self, path: &str, number: &Number, may_vanish: bool) -> Result<ProfileLaw> {
        let names = Scope { parameters: self.build.parameters, variables: self.variables };
        let value = number.expression(&names).map_err(|error| Error::from(error).under(path))?;
        let law = ProfileLaw { path: path.to_string(), value, may_vanish };
        if law.value.is_constant() {
            let check = if may_vanish { Build::not_negative } else { Build::positive };
            check(self.build, law.field(), number).map_err(|error| error.at(path))?;
        } else if self.build.parameters.get("s").is_some() {
            return Err(Error::input("`s` is the place along the beam here, but a parameter has this name too")
                .under(path)
                .hint("rename the parameter"));
        }
        Ok(law)
    }
}

fn poisson<const D: usize>(nu: &Number, build: &Build<D>) -> Result<f64> {
    let value = build.number("nu", nu)?;
    if value > -1.0 && value <= 0.5 {
        Ok(value)
    } else {
        Err(Error::input(format!("nu is {value}, but lies between -1 and 0.5")).under("nu"))
    }
}
