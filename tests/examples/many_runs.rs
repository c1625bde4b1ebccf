//! Many runs of one scene: the peak force of a suspension until it meets its bump stop, for many stiffnesses.

use holonom::prelude::*;

fn peaks(count: usize) -> holonom::Result<Vec<f64>> {
    let peak: Vec<f64> =
        Family::load("tests/examples/suspension.json")?.each("k", linspace(1e4, 5e4, count), |car| {
            let mut run = car.run();
            let end = run.until(|s| s.output("gap") - 0.01, 5.0)?;
            assert!(matches!(end, End::Event(_) | End::Reached));
            Ok(run.record().output("force")?.max_abs())
        })?;
    Ok(peak)
}

fn main() -> holonom::Result<()> {
    for (k, peak) in linspace(1e4, 5e4, 8).zip(peaks(8)?) {
        println!("k = {k:.0} N/m: {peak:.0} N");
    }
    Ok(())
}

#[test]
fn it_runs() -> holonom::Result<()> {
    main()
}

#[test]
fn peaks_are_those_of_the_oscillation_up_to_the_stop() -> holonom::Result<()> {
    // y = -(m g/k) (1 - cos(w t)): the force is k |y|, at most 2 m g, and k 0.19 m where the body meets the stop.
    for (k, peak) in linspace(1e4, 5e4, 9).zip(peaks(9)?) {
        let free: f64 = 2.0 * 300.0 * 9.81;
        let meets = k * 0.19 < free;
        let exact = if meets { k * 0.19 } else { free };
        // A row is not at the very top: half an output step away at most.
        let missed = if meets { 1e-7 } else { free * (k / 300.0) * 0.005_f64.powi(2) / 4.0 };
        assert!((peak - exact).abs() <= missed + 1e-7 * exact, "{k}: {peak} for {exact}");
    }
    Ok(())
}

#[test]
fn results_do_not_depend_on_the_threads() -> holonom::Result<()> {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| peaks(7))
    };
    let bits = |peaks: Vec<f64>| peaks.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(with(1)?), bits(with(2)?));
    Ok(())
}
