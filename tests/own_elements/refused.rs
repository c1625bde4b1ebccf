//! What is refused of own elements and of scenes built in code, and in which words.

use crate::examples::own_body::BallInFluid;
use crate::examples::own_force::HardeningSpring;
use crate::examples::own_joint::PointOnParabola;
use holonom::body::{Build, Frame, Wrench};
use holonom::force::{self, Action, ForceKernel, ForceSpec, Instant, Motion};
use holonom::joint::{BuiltJoint, JointKernel, JointSpec};
use holonom::math::{Scalar, Time};
use holonom::prepared::Model;
use holonom::scene::{Elements, SceneBuilder, json};
use schemars::JsonSchema;
use serde::Deserialize;

fn elements() -> Elements {
    let elements =
        Elements::default().with_joint::<PointOnParabola>().and_then(Elements::with_force::<HardeningSpring>);
    elements.and_then(Elements::with_body::<BallInFluid>).unwrap()
}

fn bead() -> SceneBuilder {
    SceneBuilder::new("bead", 2).body("bead", "point_mass", json!({ "mass": 1 }))
}

fn refusal(scene: SceneBuilder, elements: &Elements) -> String {
    scene.build(elements).map(|_| ()).unwrap_err().to_string()
}

/// The words of built-in elements, with the names of own ones among those to choose from.
#[test]
fn scenes_are_refused_in_the_words_of_built_in_elements() {
    let between = json!({ "between": ["ground", "bead"] });
    let joint = |kind: &str| bead().joint("wire", kind, between.clone());
    let table = [
        (
            joint("point_on_parabel"),
            "joints[0].type (`wire`): there is no joint of type `point_on_parabel`\n  help: did you mean `point_on_parabola`?",
        ),
        (joint("point_on_parabola"), "joints[0] (`wire`): the key `curvature` is missing"),
        (
            bead().force(
                "s",
                "hardening_spring",
                json!({ "between": ["ground", "bead"], "stiffness": -1, "hardening": 0 }),
            ),
            "forces[0].stiffness (`s`): stiffness is -1, but cannot be negative",
        ),
        (bead().body("b", "ball", json!({})), "bodies[1].type (`b`): there is no body of type `ball`"),
        (bead().body("b", "point_mass", json!(3)), "bodies[1]: expected an object {...}, found 3"),
        (bead().with("gravty", 3), "unknown key `gravty`\n  help: did you mean `gravity`?"),
        (bead().with("ground", 3).ground_marker("O", [0, 0]), "ground: expected an object {...}, found 3"),
        (bead().with("gravity", [0.0, f64::NAN]), "gravity[1]: expected a number or an expression"),
        (SceneBuilder::new("none", 2), "bodies: the scene has no body"),
    ];
    for (scene, expected) in table {
        let found = refusal(scene, &elements());
        assert!(found.contains(expected), "{found}\nand not\n{expected}");
    }
    let found = refusal(joint("point_on_parabola"), &Elements::default());
    assert!(found.contains("there is no joint of type `point_on_parabola`"), "{found}");
}

#[test]
fn a_type_name_is_given_once() {
    let error = elements().with_joint::<PointOnParabola>().map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("there is a joint of type `point_on_parabola` already"), "{error}");
}

#[test]
fn the_schema_has_them() {
    let schema = |elements: Elements| elements.schema()["properties"]["joints"]["items"].to_string();
    assert!(schema(elements()).contains("point_on_parabola"));
    assert!(!schema(Elements::default()).contains("point_on_parabola"));
}

/// A joint with more rows than the model holds.
#[derive(Deserialize, JsonSchema)]
struct Overdone {}

impl JointSpec for Overdone {
    const TYPE: &'static str = "overdone";

    fn build<const D: usize>(&self, build: &Build<D>) -> holonom::Result<BuiltJoint<D>> {
        Ok(BuiltJoint { joint: Box::new(Seven), markers: vec![build.marker("at", "bead")?] })
    }
}

struct Seven;

impl<const D: usize> JointKernel<D> for Seven {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["x"; 7]
    }
    fn depends_on_time(&self) -> bool {
        false
    }
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], _: Time<S>, out: &mut [S]) {
        out.fill(frames[0].r[0]);
    }
}

#[test]
fn what_a_type_makes_wrong_is_its_own_mistake() {
    let elements = Elements::default().with_joint::<Overdone>().unwrap();
    let found = refusal(bead().joint("j", "overdone", json!({})), &elements);
    assert!(found.contains("joints[0].type (`j`)") && found.contains("7 rows; 1 to 6 are possible"), "{found}");
}

/// A force in the plane alone that has a switching function, and says nothing of its argument.
#[derive(Deserialize, JsonSchema)]
struct Forgetful {}

impl ForceSpec for Forgetful {
    const TYPE: &'static str = "forgetful";

    fn build<const D: usize>(&self, build: &Build<D>) -> holonom::Result<force::BuiltForce<D>> {
        build.needs_dimension(2, "a forgetful force", "\"spring_damper\"")?;
        build.switch();
        Ok(force::BuiltForce { force: Box::new(Still), markers: vec![build.marker("at", "bead")?] })
    }
}

struct Still;

impl<const D: usize> ForceKernel<D> for Still {
    fn act<S: Scalar>(&self, _: &Motion<S, D>, _: Instant<S>, _: &mut [Wrench<S, D>]) -> Action<S> {
        Action::without_potential(S::zero())
    }
}

#[test]
fn a_switching_function_without_an_argument_is_refused() {
    let elements = Elements::default().with_force::<Forgetful>().unwrap();
    let scene = bead().force("f", "forgetful", json!({})).build(&elements).unwrap();
    let found = Model::new(scene, &Default::default()).map(|_| ()).unwrap_err().to_string();
    assert!(
        found.contains("the type of the force `f` has a switching function whose argument it never writes"),
        "{found}"
    );
    let spatial = SceneBuilder::new("s", 3).body("bead", "point_mass", json!({ "mass": 1 }));
    let found = refusal(spatial.force("f", "forgetful", json!({})), &elements);
    assert!(found.contains("a forgetful force needs \"dimension\": 2"), "{found}");
}
