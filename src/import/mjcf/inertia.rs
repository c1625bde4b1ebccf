//! Mass properties of bodies: given, or those of their geoms.

use super::MjcfReader;
use super::bodies::PlacedElement;
use super::geom;
use crate::body::MassProperties;
use crate::error::{Result, short};
use crate::import::xml::{Element, faulty};

impl<'a, 'i> MjcfReader<'a, 'i> {
    /// Mass properties of a body from its origin, in its axes.
    pub fn mass(&mut self, parts: &[PlacedElement<'a, 'i>], name: &str) -> Result<Option<MassProperties>> {
        let inertial = parts.iter().find(|part| part.node.has_tag_name("inertial"));
        let geoms: Vec<&PlacedElement> = parts.iter().filter(|part| part.node.has_tag_name("geom")).collect();
        self.told.add_if(!geoms.is_empty(), "contacts of the bodies", name);
        match (inertial, self.settings.from_geoms) {
            (Some(inertial), None | Some(false)) => self.inertial(inertial).map(Some),
            (inertial, Some(false)) => inertial.map(|inertial| self.inertial(inertial)).transpose(),
            (Some(inertial), _) if geoms.is_empty() => self.inertial(inertial).map(Some),
            _ => self.of_geoms(&geoms, name),
        }
    }

    fn inertial(&self, part: &PlacedElement<'a, 'i>) -> Result<MassProperties> {
        let element = Element::plain(part.node);
        let mass = element.needed("mass")?;
        if mass < 0.0 {
            return Err(faulty(part.node, format!("the mass is {}, but cannot be negative", short(mass))));
        }
        let [xx, yy, zz, xy, xz, yz] = match (element.numbers::<6>("fullinertia")?, element.numbers("diaginertia")?) {
            (Some(full), _) => full,
            (None, Some([x, y, z])) => [x, y, z, 0.0, 0.0, 0.0],
            (None, None) => return Err(faulty(part.node, "<inertial> has no `diaginertia`")),
        };
        let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let frame = part.frame.then(&self.settings.place(&element)?);
        Ok(frame.mass(&MassProperties { mass, centre: [0.0; 3], inertia }))
    }

    fn of_geoms(&mut self, geoms: &[&PlacedElement<'a, 'i>], name: &str) -> Result<Option<MassProperties>> {
        let mut parts = Vec::new();
        for part in geoms {
            let element = self.classes.element(part.node, &["geom"], part.class)?;
            let group = element.number_or("group", 0.0)?;
            if group < self.settings.groups[0] || group > self.settings.groups[1] {
                continue;
            }
            match geom::mass(&element, &self.settings)? {
                Some(mass) => parts.push(part.frame.mass(&mass)),
                None => self.told.add("mass of the meshes, as files of meshes are not read, of the bodies", name),
            }
            let is_shell = element.is("shellinertia", "true");
            self.told.add_if(is_shell, "shellinertia, as geoms are taken as solid, of the bodies", name);
        }
        Ok((!parts.is_empty()).then(|| MassProperties::sum(parts)))
    }

    /// Scales all masses to their given sum.
    pub fn scale_masses(&mut self) {
        let masses = || self.robot.links.iter().filter_map(|link| Some(link.mass.as_ref()?.mass));
        let sum: f64 = masses().sum();
        let Some(total) = self.settings.total_mass.filter(|_| sum > 0.0) else { return };
        for mass in self.robot.links.iter_mut().filter_map(|link| link.mass.as_mut()) {
            mass.mass *= total / sum;
            mass.inertia.iter_mut().flatten().for_each(|entry| *entry *= total / sum);
        }
    }
}
