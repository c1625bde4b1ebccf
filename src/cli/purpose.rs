//! What each method is for, in the words of someone who has to choose.

/// The name of a formulation, an integrator or a projection. Empty for a name that is none, which a test refuses.
pub fn purpose(name: &str) -> &'static str {
    match name {
        "index1" => "almost every motion: the cheapest step; give it a projection",
        "index2" => "half-explicit methods: velocities that hold, and reactions without second derivatives of phi",
        "index3" => "structural dynamics, and implicit methods that damp what is fast",
        "ggl" => "stiff motions that must keep both constraints without a projection",
        "stabilized_index1" => "the same with reactions that are free of what a step leaves along the constraints",
        "baumgarte" => "real time with fixed steps, and comparison with older codes; gains about 1/h",
        "invariant_manifold" => "fixed steps, and studies of how fast an error should decay",
        "force_projection" => "control: forces and constraint errors apart, no gain in the forces themselves",
        "penalty" => "singular positions and redundant joints where three or four digits do",
        "augmented_lagrangian" => "the same with more digits",
        "udwadia_kalaba" => "a check by another way to lambda, redundant rows included; small systems",
        "null_space" => "small systems with few degrees of freedom: no drift, fewest states, no gains to choose",
        "heun" => "tests, and constraints or forces that are not smooth",
        "rk4" => "fixed steps where nothing is stiff: real time, comparison with other codes",
        "dopri5" => "three to five digits where nothing is stiff",
        "dop853" => "five digits to round-off where nothing is stiff: the first choice",
        "hem3" => "fixed steps at low accuracy with exact velocity constraints",
        "hem4" => "the same at medium accuracy",
        "hem5" => "the same at high accuracy",
        "phem56" => "tight tolerances with exact velocity constraints",
        "radau_iia" => "stiff motions at any accuracy, also fast oscillations that are at rest",
        "rattle" => "long motions without loss, where the energy must not drift; M constant",
        "generalized_alpha" => "the slow motion of stiff structures, whose fast oscillations it damps",
        "ali3p" => "redundant constraints, and motions through singular positions",
        "bdf" => "smooth and damped stiff motions over long times",
        "tr_bdf2" => "stiff motions at two or three digits",
        "esdirk34" => "stiff motions at three to five digits, oscillating ones too",
        "none" => "formulations that hold phi and phi' themselves, and to see how far the others drift",
        "position" => "loops that must close while velocities are someone else's",
        "velocity" => "velocities that must fit while small gaps do not matter",
        "manifold" => "every run: both levels for one factorization",
        "full" => "long runs at coarse steps, where second derivatives pay",
        "exact" => "references, and both constraints at round-off",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::purpose;
    use crate::{formulation, integrator, projection};

    #[test]
    fn every_method_is_for_something() {
        let formulations = formulation::registry().iter().map(|entry| entry.name);
        let integrators = integrator::registry().iter().map(|entry| entry.name);
        let projections = projection::registry().iter().map(|entry| entry.name);
        let useless: Vec<&str> =
            formulations.chain(integrators).chain(projections).filter(|name| purpose(name).is_empty()).collect();
        assert!(useless.is_empty(), "give these a line above: {useless:?}");
    }
}
