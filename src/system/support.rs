//! The velocities that move a marker.

use crate::body::MarkerId;
use crate::scene::Model;

/// The velocities of the whole system that move one marker, in increasing order; none on the ground.
#[derive(Clone, Debug, Default)]
pub(super) struct Support {
    pub body: Option<usize>,
    pub velocities: Vec<usize>,
    is_contiguous: bool,
}

impl Support {
    pub fn of<const D: usize>(model: &Model<D>, marker: MarkerId) -> Support {
        let Some(body) = model.markers.bodies[marker] else { return Support::default() };
        let part = &model.bodies[body];
        let mut velocities = part.facts.support(marker - part.first_marker);
        velocities.iter_mut().for_each(|velocity| *velocity += part.first_v);
        let is_contiguous = velocities.windows(2).all(|pair| pair[1] == pair[0] + 1);
        Support { body: Some(body), velocities, is_contiguous }
    }

    /// target += the forces that `pull` writes on these velocities; `pulled` is scratch.
    #[inline]
    pub fn add_to(&self, target: &mut [f64], pulled: &mut Vec<f64>, pull: impl FnOnce(&mut [f64])) {
        let Some(&first) = self.velocities.first() else { return };
        if self.is_contiguous {
            return pull(&mut target[first..first + self.velocities.len()]);
        }
        pulled.clear();
        pulled.resize(self.velocities.len(), 0.0);
        pull(pulled);
        self.velocities.iter().zip(pulled.iter()).for_each(|(&velocity, f)| target[velocity] += f);
    }
}
