//! Warnings about error bars.

use crate::scenes::parse;
use holonom::analysis::Recorder;
use holonom::error::Failure;
use holonom::report::summarize;
use holonom::simulate::simulate;
use holonom::study::ErrorBars;

/// What was interrupted is not helped by another method.
#[test]
fn the_hint_is_that_of_the_failure() {
    let scene = parse(
        r#"{ "name": "mass", "dimension": 2, "bodies": [{ "name": "p", "type": "point_mass", "mass": 1 }],
            "simulation": { "t_end": 1 } }"#,
    );
    let prepared = &scene.0;
    let mut recorder = Recorder::new(scene.system());
    let span = prepared.span().unwrap();
    let outcome = simulate(scene.system(), &prepared.method, span, prepared.start(), &mut recorder).unwrap();
    let record = recorder.finish();
    let hint = |hint: &str| {
        let failure = Failure { t: 1.0, reason: "interrupted".to_string(), hint: hint.to_string() };
        let bars = ErrorBars {
            rtol: 1e-9,
            atol: 1e-11,
            step: None,
            work: 0.5,
            outputs: Vec::new(),
            second_opinion: None,
            amplification: Err(String::new()),
            failure: Some(failure),
        };
        let summary = summarize(prepared, None, &[], &outcome, &[], &record, 0.0).checked(bars);
        let mut warnings = summary.origin.warnings.into_iter();
        warnings.find(|warning| warning.text.starts_with("the companion of the run")).map(|warning| warning.hint)
    };
    assert_eq!(hint("it is in here"), Some("it is in here".to_string()));
    assert!(hint("").is_some_and(|hint| hint.starts_with("compare with")));
}
