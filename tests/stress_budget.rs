//! What a budget is spent on. Alone in its file, since other tests would take its time.

use holonom::compare::stress::{Limits, Status, Subject, maps, stress};
use holonom::prepared::Overrides;
use std::path::Path;
use std::time::{Duration, Instant};

/// Less than all cells take.
const BUDGET: Duration = Duration::from_secs(8);

#[test]
fn no_corner_and_no_method_takes_the_budget_of_others() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    for name in ["quarter_car", "five_link_suspension"] {
        let subject = Subject::load(&folder.join(name).with_extension("json"), &Overrides::default()).unwrap();
        let map = maps(&subject, &["stiffness".to_string()]).unwrap().remove(0);
        let clock = Instant::now();
        let limits = Limits { cell: Duration::from_secs(1), end: clock + BUDGET };
        let stressed = stress(&subject, map, limits, &|| {});
        // A step that has begun is ended, and what a scene costs to read.
        assert!(clock.elapsed() < BUDGET + BUDGET / 10, "{name}: {:?}", clock.elapsed());
        for verdict in stressed.verdicts() {
            assert!(verdict.completed >= 5, "{name}: {verdict:?}");
        }
        // The scene's own mass, at stiffnesses about its own.
        assert!((0..2).all(|method| stressed.cell(method, 4, 3).unwrap().status == Status::Completed), "{name}");
    }
}
