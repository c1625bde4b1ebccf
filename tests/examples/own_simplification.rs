//! An own kind of simplification: a pendulum becomes a point mass on a massless rod.

use holonom::parts::json;
use holonom::research::simplify::{Candidate, Facts, Proposal, SimplificationSettings, Source, simplify};
use holonom::run::Overrides;

/// A rigid body with a small moment of inertia on a pin of the ground, by its part J/(m l^2) of the whole.
struct MathematicalPendulum;

impl Candidate for MathematicalPendulum {
    fn name(&self) -> &'static str {
        "mathematical_pendulum"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let body = &facts.scene()["bodies"][0];
        let number = |key: &str| facts.number(&body[key]);
        let length = facts.lengths("ground.O", "bob").map(|[_, mean, _]| mean);
        let (Some(mass), Some(inertia), Some(length)) = (number("mass"), number("inertia"), length) else {
            return Vec::new();
        };
        vec![Proposal {
            subject: "bob".to_string(),
            what: "bob becomes a point mass".to_string(),
            why: "its moment of inertia is small".to_string(),
            effect: inertia / (mass * length * length),
            edit: Box::new(move |scene| {
                let initial = scene["bodies"][0]["initial"].clone();
                scene["bodies"][0] = json!({ "name": "bob", "type": "point_mass", "mass": mass, "initial": initial });
                scene["joints"][0] =
                    json!({ "name": "O", "type": "distance", "between": ["ground.O", "bob"], "length": length });
                Ok(())
            }),
        }]
    }
}

#[test]
fn it_is_tried_as_the_others_are() -> holonom::Result<()> {
    let scene = json!({
        "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0] } },
        "bodies": [{ "name": "bob", "type": "rigid", "mass": 2, "inertia": 0.002, "markers": { "A": [-1, 0] },
                     "initial": { "position": [1, 0] } }],
        "joints": [{ "name": "O", "type": "revolute", "between": ["ground.O", "bob.A"] }],
        "outputs": [{ "name": "height", "measure": "position", "of": "bob", "component": "y" }],
        "simulation": { "t_end": 1 }
    });
    // No part of an own one: in this test, counted time decides which models are too slow.
    holonom::clock::count_readings();
    let source = Source::new(scene, &Overrides::default())?;
    let settings = SimplificationSettings { within: 0.01, ..SimplificationSettings::default() };
    let found = simplify(&source, &settings, &[&MathematicalPendulum], &|| false, &mut |_, _| ())?;
    assert_eq!((found.richest.velocities, found.chosen.velocities), (3, 2));
    assert!(found.chosen.error() > 1e-5 && found.chosen.error() < 0.01);
    Ok(())
}
