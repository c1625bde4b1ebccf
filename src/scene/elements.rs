//! The kinds of bodies, joints and forces, and the own methods, that a scene may name.

use crate::body::{self, BodyKind, BodySpec, ElementKind};
use crate::error::{Error, Result};
use crate::force::{self, ForceKind, ForceSpec};
use crate::joint::{self, JointKind, JointSpec};
use crate::method_spec::{Listed, OwnMethods};

/// The kinds of elements and the methods that scenes may name: the built-in ones, and those that a user adds.
///
/// `Elements::default().with_joint::<PointOnParabola>()?.parse(text, &[])?` is a scene that may say
/// `"type": "point_on_parabola"`, as in `tests/examples/own_joint.rs`.
///
/// A kind is a type that reads what a scene says of it ([`BodySpec`], [`JointSpec`], [`ForceSpec`]) and makes its
/// equations ([`BodyKernel`](body::BodyKernel), [`JointKernel`](joint::JointKernel),
/// [`ForceKernel`](force::ForceKernel)). It is then used like a built-in one in every formulation, in linear models,
/// outputs and the energy balance. A method is a `static` entry: see [`with_method`](Self::with_method).
#[derive(Clone, Debug)]
pub struct Elements {
    pub(super) planar: Kinds<2>,
    pub(super) spatial: Kinds<3>,
    pub(crate) methods: OwnMethods,
}

/// The kinds for scenes in D dimensions.
#[derive(Clone, Debug)]
pub(super) struct Kinds<const D: usize> {
    pub bodies: Vec<BodyKind<D>>,
    pub joints: Vec<JointKind<D>>,
    pub forces: Vec<ForceKind<D>>,
}

impl<const D: usize> Kinds<D> {
    fn built_in() -> Self {
        Kinds { bodies: body::registry(), joints: joint::registry(), forces: force::registry() }
    }
}

impl Default for Elements {
    fn default() -> Self {
        Elements { planar: Kinds::built_in(), spatial: Kinds::built_in(), methods: OwnMethods::default() }
    }
}

impl Elements {
    /// The same with a kind of body more.
    ///
    /// # Errors
    /// A type name that is taken.
    pub fn with_body<T: BodySpec>(mut self) -> Result<Self> {
        add("body", &mut self.planar.bodies, body::kind::<T, 2>())?;
        add("body", &mut self.spatial.bodies, body::kind::<T, 3>())?;
        Ok(self)
    }

    /// The same with a kind of joint more.
    ///
    /// # Errors
    /// A type name that is taken.
    pub fn with_joint<T: JointSpec>(mut self) -> Result<Self> {
        add("joint", &mut self.planar.joints, joint::kind::<T, 2>())?;
        add("joint", &mut self.spatial.joints, joint::kind::<T, 3>())?;
        Ok(self)
    }

    /// The same with a kind of force more.
    ///
    /// # Errors
    /// A type name that is taken.
    pub fn with_force<T: ForceSpec>(mut self) -> Result<Self> {
        add("force", &mut self.planar.forces, force::kind::<T, 2>())?;
        add("force", &mut self.spatial.forces, force::kind::<T, 3>())?;
        Ok(self)
    }

    /// The same with a formulation, an integrator or a projection more, which `"simulation"` then names as it names
    /// built-in ones; so do the settings of [`Overrides`](crate::run::Overrides) and
    /// [`Run::method`](crate::run::Run::method). An example is `tests/examples/own_integrator.rs`.
    ///
    /// # Errors
    /// A name that is taken.
    pub fn with_method<E: Listed>(mut self, entry: &'static E) -> Result<Self> {
        self.methods = self.methods.with(entry)?;
        Ok(self)
    }
}

fn add<Make>(what: &str, known: &mut Vec<ElementKind<Make>>, new: ElementKind<Make>) -> Result<()> {
    if known.iter().any(|kind| kind.name == new.name) {
        return Err(Error::input(format!("there is a {what} of type `{}` already", new.name))
            .hint(format!("give your kind of {what} another TYPE")));
    }
    known.push(new);
    Ok(())
}
