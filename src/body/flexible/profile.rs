//! The section along a beam.

use super::gauss::{gauss_legendre, on_interval};
use super::section::{Matter, Section, SectionOutline};
use super::spec::Theory;
use crate::error::{Error, Result, short};
use crate::math::array::from_fn;
use crate::math::expression::Expression;
use crate::tolerances;

/// Number of equal parts of the beam at whose ends the section is checked.
const LOOKED_AT: u32 = 2000;
/// Gauss points for means over an element.
const POINTS: usize = 6;

/// The section of a beam as a function of s.
#[derive(Clone, Debug)]
pub struct Profile {
    form: ProfileForm,
    /// True for rotary inertia of sections in bending (Rayleigh); that in torsion is always included.
    pub rotary: bool,
}

#[derive(Clone, Debug)]
enum ProfileForm {
    Uniform(Section),
    Tapered(Laws),
}

impl Profile {
    /// The profile of these laws, which must give valid values on the whole length.
    pub(super) fn new(laws: Laws, length: f64, rotary: bool) -> Result<Self> {
        laws.check(length)?;
        let form = if laws.vary() { ProfileForm::Tapered(laws) } else { ProfileForm::Uniform(laws.at(0.0)) };
        Ok(Profile { form, rotary })
    }

    /// The same section along the whole beam; `rotary` keeps its rotary inertia.
    pub fn uniform(section: Section, rotary: bool) -> Self {
        Profile { form: ProfileForm::Uniform(section), rotary }
    }

    /// True if the section does not depend on s.
    pub fn is_uniform(&self) -> bool {
        matches!(self.form, ProfileForm::Uniform(_))
    }

    /// Section at `s`, m from the left end.
    pub fn at(&self, s: f64) -> Section {
        match &self.form {
            ProfileForm::Uniform(section) => *section,
            ProfileForm::Tapered(laws) => laws.at(s),
        }
    }

    /// Section at `s` of the element between two abscissae; at its ends, the limit from within the element.
    pub fn within(&self, ends: [f64; 2], s: f64) -> Section {
        let [from, to] = ends;
        let gap = tolerances::SAME * (to - from);
        self.at(s.clamp(from + gap, to - gap))
    }

    /// The section with the mean compliance of a part of the beam, exact for its extension, its twist and its bending
    /// under a constant moment.
    pub fn mean(&self, ends: [f64; 2]) -> Section {
        let ProfileForm::Tapered(laws) = &self.form else { return self.at(ends[0]) };
        let points: Vec<([f64; 9], f64)> =
            on_interval(&gauss_legendre(POINTS), ends).map(|(s, weight)| (laws.at(s).numbers(), weight)).collect();
        Section::of(from_fn(|i| {
            // Stiffness counts by its inverse.
            let seen = |x: f64| if i < 6 { 1.0 / x } else { x };
            let sum: f64 = points.iter().map(|(numbers, weight)| weight * seen(numbers[i])).sum();
            seen(sum / (ends[1] - ends[0]))
        }))
    }
}

/// Functions of s, and the form of the section that they describe.
#[derive(Clone, Debug)]
pub(super) struct Laws {
    pub make: SectionKind,
    pub laws: Vec<ProfileLaw>,
    pub theory: Theory,
    /// Dimension of the scene.
    pub dimension: usize,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum SectionKind {
    /// Height and width.
    Rectangle(Matter),
    /// Radius and inner radius.
    Circle(Matter),
    /// Those of [`Section::of`].
    Numbers,
}

impl Laws {
    pub fn at(&self, s: f64) -> Section {
        let value = |i: usize| self.laws[i].at(s);
        let section = match self.make {
            SectionKind::Rectangle(matter) => {
                matter.fill(&SectionOutline::rectangle(value(0), value(1)), self.dimension)
            }
            SectionKind::Circle(matter) => matter.fill(&SectionOutline::circle(value(0), value(1)), self.dimension),
            SectionKind::Numbers => Section::of(from_fn(value)),
        };
        section.of_theory(self.theory)
    }

    fn vary(&self) -> bool {
        self.laws.iter().any(ProfileLaw::varies)
    }

    fn check(&self, length: f64) -> Result<()> {
        let parts = if self.vary() { LOOKED_AT } else { 0 };
        for part in 0..=parts {
            let s = length * f64::from(part) / f64::from(LOOKED_AT);
            self.laws.iter().try_for_each(|law| law.check(s))?;
            if matches!(self.make, SectionKind::Circle(_)) && self.laws[1].at(s) >= self.laws[0].at(s) {
                let place = if self.vary() { format!(" at s = {}", short(s)) } else { String::new() };
                return Err(Error::input(format!("the inner radius is not smaller than the outer one{place}"))
                    .under("section.circle.inner_radius"));
            }
        }
        Ok(())
    }
}

/// A number along the beam, as an expression of s.
#[derive(Clone, Debug)]
pub(super) struct ProfileLaw {
    /// JSON path from the body on.
    pub path: String,
    pub value: Expression,
    /// True if it may be zero.
    pub may_vanish: bool,
}

impl ProfileLaw {
    pub fn constant(value: f64) -> Self {
        ProfileLaw { path: String::new(), value: Expression::from(value), may_vanish: true }
    }

    fn at(&self, s: f64) -> f64 {
        self.value.eval(&[s])
    }

    /// Its path without the first key, as messages name it.
    pub fn field(&self) -> &str {
        self.path.split_once('.').map_or("", |(_, field)| field)
    }

    fn varies(&self) -> bool {
        !self.value.is_constant()
    }

    /// Checks the value at `s`; constants are checked when they are read.
    fn check(&self, s: f64) -> Result<()> {
        let value = self.at(s);
        let field = self.field();
        let place = short(s);
        let error = |what: String| Err(Error::input(what).under(&self.path));
        match value {
            _ if !self.varies() => Ok(()),
            _ if !value.is_finite() => error(format!("{field}, `{}`, is not finite at s = {place}", self.value)),
            _ if value < 0.0 || (value == 0.0 && !self.may_vanish) => {
                let least = if self.may_vanish { "cannot be negative" } else { "must be above zero" };
                error(format!("{field} is {} at s = {place}, but {least} on the whole beam", short(value)))
            }
            _ => Ok(()),
        }
    }
}
