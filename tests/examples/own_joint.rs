//! An own joint: a point stays on a parabola.

use holonom::Result;
use holonom::parts::{Build, BuiltJoint, Elements, Frame, JointKernel, JointSpec, Number, Scalar, SceneBuilder, Time};
use holonom::parts::{dot, json, sub};
use holonom::run::{Model, Overrides};
use schemars::JsonSchema;
use serde::Deserialize;

/// What a scene says: the second marker stays on y = curvature x^2/2, in the axes of the first.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointOnParabola {
    between: [String; 2],
    /// At the vertex, 1/m.
    curvature: Number,
}

impl JointSpec for PointOnParabola {
    const TYPE: &'static str = "point_on_parabola";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let curvature = build.number("curvature", &self.curvature)?;
        Ok(BuiltJoint::new(Parabola { curvature }, build.between(&self.between)?))
    }
}

struct Parabola {
    curvature: f64,
}

/// One row, y - curvature x^2/2. phi', gamma, G and their derivatives follow by dual and Taylor numbers.
impl<const D: usize> JointKernel<D> for Parabola {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["y"]
    }

    fn depends_on_time(&self) -> bool {
        false
    }

    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], _: Time<S>, out: &mut [S]) {
        let gap = sub(&frames[1].r, &frames[0].r);
        let [x, y] = [0, 1].map(|axis| dot(&frames[0].axes[axis], &gap));
        out[0] = y - x.square() * (0.5 * self.curvature);
    }
}

fn main() -> Result<()> {
    let scene = SceneBuilder::new("bead", 2)
        .body("bead", "point_mass", json!({ "mass": 1, "initial": { "position": [1, 0.3] } }))
        .joint("wire", "point_on_parabola", json!({ "between": ["ground", "bead"], "curvature": 2 }))
        .build(&Elements::default().with_joint::<PointOnParabola>()?)?;
    let model = Model::new(scene, &Overrides::default())?;
    let (q, _) = model.start();
    assert!((q[1] - q[0] * q[0]).abs() < 1e-15, "assembly puts it on the parabola: {q:?}");
    println!("the bead starts at {q:?}");
    Ok(())
}

#[test]
fn scenes_use_it_by_its_type_name() -> holonom::Result<()> {
    main()
}
