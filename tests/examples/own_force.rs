//! An own force: a spring that hardens as it is stretched.

use holonom::Result;
use holonom::parts::{Action, Build, BuiltForce, Elements, ForceKernel, ForceSpec, Instant, Motion, Number, Scalar};
use holonom::parts::{Wrench, dot, norm, sub};
use holonom::run::{Model, Overrides};
use schemars::JsonSchema;
use serde::Deserialize;

/// What a scene says: a tension stiffness s + hardening s^3 between two markers, s apart.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HardeningSpring {
    between: [String; 2],
    /// N/m
    stiffness: Number,
    /// N/m^3
    hardening: Number,
}

impl ForceSpec for HardeningSpring {
    const TYPE: &'static str = "hardening_spring";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let k = build.not_negative("stiffness", &self.stiffness)?;
        let k3 = build.not_negative("hardening", &self.hardening)?;
        Ok(BuiltForce::new(Spring { k, k3 }, build.between(&self.between)?))
    }
}

struct Spring {
    k: f64,
    k3: f64,
}

/// Forces (k + k3 s^2) r along the gap r, of length s; the energy that they store is k s^2/2 + k3 s^4/4.
impl<const D: usize> ForceKernel<D> for Spring {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let gap = sub(&frames[1].r, &frames[0].r);
        let square = dot(&gap, &gap);
        let stiffness = square.x * self.k3 + self.k;
        out[0].force = gap.map(|x| x.x * stiffness);
        out[1].force = gap.map(|x| -(x.x * stiffness));
        let potential = square * (0.5 * self.k) + square.square() * (0.25 * self.k3);
        Action { potential, magnitude: norm(&out[0].force) }
    }
}

fn main() -> Result<()> {
    let elements = Elements::default().with_force::<HardeningSpring>()?;
    let scene = r#"{ "name": "bead", "dimension": 3,
        "bodies": [{ "name": "bead", "type": "point_mass", "mass": 1, "initial": { "position": [2, 0, 0] } }],
        "forces": [{ "name": "spring", "type": "hardening_spring", "between": ["ground", "bead"],
                     "stiffness": 3, "hardening": 5 }] }"#;
    let model = Model::new(elements.parse(scene, &[])?, &Overrides::default())?;
    assert_eq!(model.assembly.vdot, [-46.0, 0.0, 0.0], "-(3 2 + 5 2^3)");
    println!("the bead starts with v' = {:?}", model.assembly.vdot);
    Ok(())
}

#[test]
fn scenes_use_it_by_its_type_name() -> holonom::Result<()> {
    main()
}
