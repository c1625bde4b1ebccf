//! What is known of a body before it moves.

use super::pose::Freedom;

/// Facts of a body that never change.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyFacts {
    /// Names of the coordinates, such as `x` or `angle`.
    pub coordinate_names: Vec<String>,
    /// Names of the velocities, in the order of v.
    pub velocity_names: Vec<String>,
    /// Indices of the velocities that move each marker, in increasing order; empty where all move every marker.
    pub supports: Vec<Vec<usize>>,
    /// Places of the mass matrix's lower triangle, each once.
    pub mass_pattern: Vec<(usize, usize)>,
    /// Places of the values of K and C of the body itself; none where its own forces are constant.
    pub tangent_pattern: Vec<(usize, usize)>,
    /// Elastic stiffness at places of M, by their index in [`mass_pattern`](Self::mass_pattern): for the weights of
    /// assembly.
    pub stiffness: Vec<(usize, f64)>,
    /// True if its markers have an orientation; false for a point mass.
    pub oriented: bool,
    /// Index of the first of three velocities that are an angular velocity in the body's own axes; `None` if N = I.
    pub turning: Option<usize>,
    /// What its velocities are, for a rigid body: its markers then move with its [`pose`](super::Body::pose), and
    /// nothing in it dissipates. `None` where it is none, or makes no use of that.
    #[doc(hidden)]
    pub freedom: Option<Freedom>,
    /// True if M does not depend on q.
    pub has_constant_mass: bool,
    /// True if its own forces depend neither on q nor on v, and nothing in it dissipates.
    pub has_constant_forces: bool,
    /// Largest distance of a marker from the origin of the coordinates, m.
    pub reach: f64,
    /// Number of elastic coordinates, which are the last ones.
    pub elastic_count: usize,
    /// Largest number of coordinates it may have.
    pub most_coordinates: usize,
}

impl BodyFacts {
    /// A rigid body with coordinates and velocities of these names, N = I and a diagonal mass matrix, that makes no use
    /// of what its velocities are.
    pub fn new<'n>(
        coordinates: impl IntoIterator<Item = &'n str>,
        velocities: impl IntoIterator<Item = &'n str>,
    ) -> Self {
        let velocity_names: Vec<String> = velocities.into_iter().map(String::from).collect();
        let n = velocity_names.len();
        BodyFacts {
            coordinate_names: coordinates.into_iter().map(String::from).collect(),
            velocity_names,
            supports: Vec::new(),
            mass_pattern: (0..n).map(|i| (i, i)).collect(),
            tangent_pattern: (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).collect(),
            stiffness: Vec::new(),
            oriented: true,
            turning: None,
            freedom: None,
            has_constant_mass: true,
            has_constant_forces: false,
            reach: 0.0,
            elastic_count: 0,
            most_coordinates: usize::MAX,
        }
    }

    /// Indices of the velocities that move a marker, in increasing order.
    pub fn support(&self, marker: usize) -> Vec<usize> {
        let all = || (0..self.velocity_names.len()).collect();
        self.supports.get(marker).cloned().unwrap_or_else(all)
    }
}
