//! Linear models of every shipped scene against perturbed simulations.

use holonom::linearize::states;
use holonom::study::Study;
use holonom::validate::{Settings, validate};
use std::path::Path;

#[test]
#[ignore = "explores"]
fn explore() {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut names: Vec<_> = std::fs::read_dir(models).unwrap().map(|entry| entry.unwrap().path()).collect();
    names.retain(|path| path.extension().is_some_and(|e| e == "json") && !path.to_string_lossy().contains("schema"));
    names.sort();
    let only = std::env::var("ONLY").unwrap_or_default();
    for path in names.iter().filter(|path| path.to_string_lossy().contains(&only)) {
        let mut study = Study::load(path, &Default::default()).unwrap();
        study.method.rtol = study.method.rtol.min(1e-10);
        study.method.atol = study.method.atol.min(1e-10);
        let Ok(span) = study.span() else {
            println!("{}: no span", study.name);
            continue;
        };
        let length = span.end - span.start;
        let times = [0.0, 0.17, 0.43].map(|part| span.start + part * length);
        let clock = std::time::Instant::now();
        let found = match states(&study, &times, |_| {}) {
            Ok(f) => f,
            Err(e) => {
                println!("{}: {e}", study.name);
                continue;
            }
        };
        println!("{}: states {:.2} s", study.name, clock.elapsed().as_secs_f64());
        for state in found {
            let clock = std::time::Instant::now();
            match validate(study.system(), &state, &Settings::default()) {
                Ok(v) => {
                    let o = |d: &holonom::validate::Decay| {
                        format!(
                            "{}{:.3} ({:.1} dec)",
                            if d.is_exact { "exact " } else { "" },
                            d.order.unwrap_or(f64::NAN),
                            d.decades
                        )
                    };
                    println!(
                        "  t {:.4} followed {:.3e} {:.2} s: {} | lti {} | inputs {:?} | hor {:?}",
                        v.t,
                        v.followed,
                        clock.elapsed().as_secs_f64(),
                        v.ladders.iter().map(|l| o(&l.order_ltv)).collect::<Vec<_>>().join(", "),
                        o(&v.frozen.decay),
                        v.inputs.iter().map(|i| (o(&i.order_ltv), i.error_lti)).collect::<Vec<_>>(),
                        v.ladders.first().map(|l| l.horizons)
                    );
                    if !(v.verdict.ltv && v.verdict.lti) {
                        println!("     {}", v.verdict.text);
                        for l in &v.ladders {
                            println!("     {:?}", l.errors_ltv);
                        }
                        println!("     lti {:?}", v.frozen.errors);
                    }
                }
                Err(e) => println!("  t {:.4}: {e}", state.t),
            }
        }
    }
}
