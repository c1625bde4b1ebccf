//! Applied force and torque: expressions of time, of marker quantities and of named outputs.

use super::{Action, BuiltForce, ForceKernel, ForceSpec, InputKind, Instant, Motion};
use crate::body::{Build, Formula, MOST_MARKERS, MarkerId, Wrench, cross, norm};
use crate::error::{Error, Result};
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::{Rate, Scalar, Taylor, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// A force at a marker.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AppliedForce {
    /// Marker `body.marker` that it acts on.
    pub at: String,
    /// Components, N: expressions of t, marker quantities (`crank.tip.x'`) and named outputs.
    pub force: Vec<Number>,
    /// Axes of the components. Default: the world's.
    #[serde(default)]
    pub axes: Axes,
    /// Marker whose body takes the opposite force along the same line, so with the moment of the gap between both markers.
    /// Default: none.
    pub reaction_on: Option<String>,
}

/// A torque at a marker.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AppliedTorque {
    /// Marker `body.marker` that it acts on.
    pub at: String,
    /// N m: one expression in the plane, three in space, of t, marker quantities (`crank.angle'`) and named outputs.
    pub torque: OneOrMany,
    /// Axes of the components. Default: the world's.
    #[serde(default)]
    pub axes: Axes,
    /// Marker that takes the opposite torque. Default: none.
    pub reaction_on: Option<String>,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Axes {
    #[default]
    World,
    Marker,
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number, an expression such as \"k*t\", or a list of these")]
pub enum OneOrMany {
    One(Number),
    Many(Vec<Number>),
}

impl ForceSpec for AppliedForce {
    const TYPE: &'static str = "applied_force";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        if self.force.len() != D {
            return Err(Error::input(format!("expected {D} numbers, found {}", self.force.len()))
                .under("force")
                .hint(format!("the scene has \"dimension\": {D}")));
        }
        let formulas = formulas("force", &self.force, build)?;
        let markers = targets(&self.at, &self.reaction_on, build)?;
        assemble(AppliedKind::Force, formulas, self.axes, markers)
    }
}

impl ForceSpec for AppliedTorque {
    const TYPE: &'static str = "applied_torque";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let formulas = match &self.torque {
            OneOrMany::One(torque) if D == 2 => vec![build.acting("torque", torque, true)?],
            OneOrMany::Many(torque) if D == 3 && torque.len() == 3 => formulas("torque", torque, build)?,
            _ => {
                let expected = if D == 2 { "one number" } else { "3 numbers" };
                return Err(Error::input(format!("expected {expected}"))
                    .under("torque")
                    .hint(format!("the scene has \"dimension\": {D}")));
            }
        };
        let markers = targets(&self.at, &self.reaction_on, build)?;
        build.oriented("at", &markers)?;
        assemble(AppliedKind::Torque, formulas, self.axes, markers)
    }
}

fn formulas<const D: usize>(field: &str, numbers: &[Number], build: &Build<D>) -> Result<Vec<Formula>> {
    numbers.iter().enumerate().map(|(i, number)| build.acting(&format!("{field}[{i}]"), number, true)).collect()
}

fn targets<const D: usize>(at: &str, reaction: &Option<String>, build: &Build<D>) -> Result<Vec<MarkerId>> {
    let mut markers = vec![build.marker("at", at)?];
    if let Some(name) = reaction {
        markers.push(build.marker("reaction_on", name)?);
    }
    if markers.iter().all(|&marker| build.markers.bodies[marker].is_none()) {
        let error = Error::input(format!("`{at}` is on the ground, which no force moves")).under("at");
        return Err(error.hint("name a marker of a body"));
    }
    Ok(markers)
}

/// A force whose first markers are the acting and the reacting one, followed by those that the expressions read.
fn assemble<const D: usize>(
    kind: AppliedKind,
    formulas: Vec<Formula>,
    axes: Axes,
    targets: Vec<MarkerId>,
) -> Result<BuiltForce<D>> {
    let markers = formulas.iter().fold(targets.clone(), |own, formula| formula.markers_after(&own));
    if markers.len() > MOST_MARKERS {
        return Err(Error::input(format!("uses {} markers", markers.len()))
            .hint(format!("use at most {MOST_MARKERS} in one force")));
    }
    let force = Applied { kind, formulas, axes, reacts: targets.len() > 1, markers: markers.clone() };
    Ok(BuiltForce { force: Box::new(force), markers })
}

enum AppliedKind {
    Force,
    Torque,
}

struct Applied {
    kind: AppliedKind,
    /// One expression for each component; a planar torque has the third only.
    formulas: Vec<Formula>,
    axes: Axes,
    reacts: bool,
    markers: Vec<MarkerId>,
}

impl Applied {
    fn components<S: Scalar, const D: usize>(&self, frames: &Motion<S, D>, time: Time<S>) -> [S; 3] {
        let value = |formula: &Formula| formula.at(time, &self.markers, frames);
        match self.formulas.as_slice() {
            [torque] => [S::zero(), S::zero(), value(torque)],
            all => from_fn(|i| all.get(i).map_or(S::zero(), value)),
        }
    }
}

impl<const D: usize> ForceKernel<D> for Applied {
    fn input(&self) -> InputKind {
        InputKind::Component
    }

    fn acted(&self, _markers: usize) -> usize {
        1 + usize::from(self.reacts)
    }

    fn is_torque(&self) -> bool {
        matches!(self.kind, AppliedKind::Torque)
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        self.driven(&[Taylor::fixed(S::zero()); 3], frames, time, out)
    }

    fn switching(&self, _input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        for formula in &self.formulas {
            formula.switching_at(time.map(|t| t.x), &self.markers, frames, out);
        }
    }

    fn driven<S: Scalar>(
        &self,
        input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        let own = self.components(frames, time.map(|t| t.x));
        let local: [S; 3] = from_fn(|i| own[i] + input[i].x);
        let mut vector = local;
        if self.axes == Axes::Marker && !(D == 2 && matches!(self.kind, AppliedKind::Torque)) {
            vector = [S::zero(); 3];
            for (axis, component) in frames[0].axes.iter().zip(local) {
                axis.iter().zip(&mut vector).for_each(|(a, sum)| *sum += a.x * component);
            }
        }
        match self.kind {
            AppliedKind::Force => out[0].force.copy_from_slice(&vector[..D]),
            AppliedKind::Torque => out[0].torque = vector,
        }
        if self.reacts {
            // The reaction acts along the same line, so at the other marker it has the moment of the gap.
            let gap: [S; D] = from_fn(|i| frames[0].r[i].x - frames[1].r[i].x);
            let lever = cross(&gap, &out[0].force);
            out[1].force = out[0].force.each(|x| -x);
            out[1].torque = from_fn(|i| -(out[0].torque[i] + lever[i]));
        }
        // A planar torque keeps its sign.
        Action::without_potential(if self.formulas.len() == 1 { vector[2] } else { norm(&vector) })
    }
}
