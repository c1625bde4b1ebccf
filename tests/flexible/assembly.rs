//! A start that is off is closed by moving bodies, not by bending them.

/// The slider is guessed a centimetre off, the crank 0.1 rad, the rod's turn left out: nothing needs to bend to close this.
/// What is left is a part of the gap, mass over stiffness times a second squared: at most 1277^-2 = 6e-7 of it.
#[test]
fn loops_close_by_rigid_motion() {
    let text = std::fs::read_to_string(crate::scenes::model("flexible_slider_crank_fe")).unwrap();
    let slip = text
        .replace(r#""position": ["l1 + l2"]"#, r#""position": ["l1 + l2 - 0.01"]"#)
        .replace(r#""position": ["l1/2", 0]"#, r#""position": ["l1/2", 0], "angle": 0.1"#)
        .replace(r#", "angular_velocity": "-omega*l1/l2""#, "");
    assert_ne!(slip, text);
    let ready = crate::scenes::parse(&slip);
    let start = ready.start();
    assert!(start.before.phi > 0.01 && start.after.phi < 1e-10, "{:?} {:?}", start.before, start.after);
    let names = ready.system().facts().names.clone();
    let elastic = |names: &[String], values: &[f64]| -> f64 {
        let rod = names.iter().zip(values).filter(|(name, _)| name.starts_with("rod.n") || name.starts_with("rod.m"));
        rod.fold(0.0, |largest, (_, x)| largest.max(x.abs()))
    };
    assert!(elastic(&names.q, &start.q) < 6e-8, "{:?}", start.q);
    // A gap of some hundred m/s and rad/s.
    assert!(elastic(&names.v, &start.v) < 2e-4, "{:?}", start.v);
}
