//! Closed forms of rigid bodies and of the joints between them, against the frames and kernels that define them.

mod evaluate;
mod tangent;

use holonom::body::flexible::PointShape;
use holonom::body::{Bent, Body, BodyFacts, BodyOver, BodyState, Energy, Frame, Marker, Pose, Wrench};
use holonom::joint::{Axis, ClosedForm, Joint, JointOver};
use holonom::math::{Rate, Scalar, Taylor, Time};
use holonom::scene::{AnyModel, Connection, Model, Part, Scene};
use serde_json::Value;

/// The model of a scene in the plane.
fn planar(scene: &Value) -> Model<2> {
    match Scene::parse(&scene.to_string(), &[]).unwrap_or_else(|error| panic!("{error}: {scene}")).model {
        AnyModel::Planar(model) => model,
        AnyModel::Spatial(_) => panic!("a scene in space: {scene}"),
    }
}

/// The model of a scene in space.
fn spatial(scene: &Value) -> Model<3> {
    match Scene::parse(&scene.to_string(), &[]).unwrap_or_else(|error| panic!("{error}: {scene}")).model {
        AnyModel::Spatial(model) => model,
        AnyModel::Planar(_) => panic!("a scene in the plane: {scene}"),
    }
}

/// The same model with joints that have no closed form.
fn with_generic_joints<const D: usize>(mut model: Model<D>) -> Model<D> {
    let generic = |joint: Connection<Box<dyn Joint<D>>>| {
        assert!(joint.element.closed_form().is_some() || joint.kind == "driver", "{} has no closed form", joint.kind);
        Connection { element: Box::new(GenericJoint(joint.element)) as Box<dyn Joint<D>>, ..joint }
    };
    model.joints = model.joints.into_iter().map(generic).collect();
    model
}

/// The same model with bodies that do not say that they are rigid.
fn with_generic_bodies<const D: usize>(mut model: Model<D>) -> Model<D> {
    let generic = |part: Part<D>| {
        assert!(part.facts.freedom.is_some(), "{} is not rigid", part.name);
        let body = Box::new(GenericBody(part.body)) as Box<dyn Body<D>>;
        Part { facts: Box::new(body.facts()), body, ..part }
    };
    model.bodies = model.bodies.into_iter().map(generic).collect();
    model
}

/// A joint without its closed form.
struct GenericJoint<const D: usize>(Box<dyn Joint<D>>);

/// A rigid body that moves its markers by its own frame alone.
struct GenericBody<const D: usize>(Box<dyn Body<D>>);

/// Methods that do what those of the wrapped element do.
macro_rules! same {
    ($(fn $name:ident(&self $(, $argument:ident: $kind:ty)*) $(-> $out:ty)?;)*) => {
        $(fn $name(&self $(, $argument: $kind)*) $(-> $out)? {
            (*self.0).$name($($argument),*)
        })*
    };
}

impl<S: Scalar, const D: usize> JointOver<S, D> for GenericJoint<D>
where
    dyn Joint<D>: JointOver<S, D>,
{
    same! {
        fn levels(&self, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]);
        fn driven(&self, input: Taylor<S>, frames: &[Frame<Taylor<S>, D>], time: Time<Taylor<S>>, out: &mut [Taylor<S>]);
        fn gradient(&self, frames: &[Frame<Taylor<S>, D>], time: Time<S>, pass: usize, out: &mut [[S; 6]]);
    }
}

impl<const D: usize> Joint<D> for GenericJoint<D> {
    fn closed_form(&self) -> Option<ClosedForm<D>> {
        None
    }
    same! {
        fn row_names(&self) -> Vec<&'static str>;
        fn depends_on_time(&self) -> bool;
        fn prescribes(&self) -> bool;
        fn prescribed(&self, t: f64) -> Option<f64>;
        fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis>;
        fn switching(&self, frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]);
    }
}

impl<S: Scalar, const D: usize> BodyOver<S, D> for GenericBody<D>
where
    dyn Body<D>: BodyOver<S, D>,
{
    same! {
        fn rate(&self, q: &[S], v: &[S], qdot: &mut [S]);
        fn motion(&self, q: &[S], v: &[S], vdot: Option<&[S]>, first: usize, out: &mut [Frame<Taylor<S>, D>]);
        fn pull_back(&self, marker: usize, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]);
        fn energy(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S>;
    }
}

impl<const D: usize> Body<D> for GenericBody<D> {
    fn facts(&self) -> BodyFacts {
        BodyFacts { freedom: None, ..self.0.facts() }
    }
    same! {
        fn markers(&self) -> &[Marker<D>];
        fn mass(&self, q: &[f64], values: &mut [f64]);
        fn own_forces(&self, q: &[f64], v: &[f64], gravity: &[f64; D], f: &mut [f64]);
        fn tangent(&self, at: BodyState<D>, k: &mut [f64], c: &mut [f64]);
        fn dissipation(&self, v: &[f64]) -> f64;
        fn normalize(&self, q: &mut [f64]);
        fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D>;
        fn shapes(&self) -> &[PointShape<D>];
        fn bent(&self) -> Option<Bent<'_, D>>;
    }
}
