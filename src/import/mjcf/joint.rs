//! Joints of bodies.

use super::MjcfReader;
use super::bodies::PlacedElement;
use crate::error::{Error, Result, excerpt};
use crate::import::robot::{Joint, JointType};
use crate::import::transform::Transform;
use crate::import::xml::{Element, place};

const KINDS: [(&str, JointType); 4] = [
    ("hinge", JointType::Revolute),
    ("slide", JointType::Prismatic),
    ("ball", JointType::Spherical),
    ("free", JointType::Floating),
];

impl<'a, 'i> MjcfReader<'a, 'i> {
    /// A joint of a body; the frame of the child stands at `origin` in that of the parent.
    pub fn joint(
        &mut self,
        part: &PlacedElement<'a, 'i>,
        body: &str,
        ends: [usize; 2],
        origin: Transform,
    ) -> Result<Joint> {
        let node = part.node;
        let is_free = node.has_tag_name("freejoint");
        let element =
            if is_free { Element::plain(node) } else { self.classes.element(node, &["joint"], part.class)? };
        let found = if is_free { "free" } else { element.text("type").unwrap_or("hinge") };
        let kind = JointType::find(node, found, &KINDS)?;
        let name = node.attribute("name").map_or_else(|| format!("{body}_joint"), str::to_string);
        if kind == JointType::Floating && ends[0] != 0 {
            return Err(Error::input(format!("the free joint `{}` is not in a body of the world", excerpt(&name)))
                .placed(place(node)));
        }
        self.tell_unused(&element, &name)?;
        let unit = if kind == JointType::Revolute { self.settings.unit } else { 1.0 };
        let mut joint = Joint::new(name.clone(), node.range().start, kind, ends, origin);
        let point = Transform { r: element.numbers("pos")?.unwrap_or_default(), ..Transform::default() };
        joint.anchor = part.frame.then(&point).r;
        joint.axis = part.frame.rotated(&element.numbers_or("axis", [0.0, 0.0, 1.0])?);
        joint.reference = unit * element.number_or("ref", 0.0)?;
        joint.relaxed = unit * element.number_or("springref", 0.0)?;
        joint.armature = element.number_or("armature", 0.0)?;
        joint.stiffness = self.linear(&element, "stiffness", &name)?;
        joint.damping = self.linear(&element, "damping", &name)?;
        Ok(joint)
    }

    /// The first coefficient of a force; the others are told.
    fn linear(&mut self, element: &Element, key: &str, name: &str) -> Result<f64> {
        let coefficients = element.list(key)?;
        let has_more = coefficients.iter().skip(1).any(|x| *x != 0.0);
        self.told.add_if(has_more, &format!("{key} beyond the linear term of the joints"), name);
        Ok(coefficients.first().copied().unwrap_or(0.0))
    }

    fn tell_unused(&mut self, element: &Element, name: &str) -> Result<()> {
        let range = element.has("range")? && !element.is("limited", "false");
        self.told.add_if(range || element.is("limited", "true"), "limits of the joints", name);
        self.told.add_if(element.has("frictionloss")?, "dry friction (frictionloss) of the joints", name);
        self.told.add_if(element.has("springdamper")?, "springdamper of the joints", name);
        self.told.add_if(element.has("actuatorfrcrange")?, "bounds of the actuator forces at the joints", name);
        Ok(())
    }
}
