use crate::models::{at, request};
use crate::scenes::shipped;
use holonom::linearize::*;
fn show(variation: &mut Variation, method: &str) {
    match linearize(variation, &request(method, None)) {
        Ok(found) => { println!("{method} off {:?}", found.cost.off_constraints); for m in &found.modes { if m.kind != Kind::Infinite { println!("   {:?} {:e} {:e} shape {:.3?}", m.kind, m.value.re, m.value.im, m.shape.iter().map(|x| x.norm()).collect::<Vec<_>>()); } } }
        Err(e) => println!("{method} {e}"),
    }
}
#[test]
fn debug() {
    at("two_mass_eq", |variation, _| { show(variation, "rcs:form=index1,solver=qz"); show(variation, "rcs:form=index1"); });
    at("four_bar_S1", |variation, _| { show(variation, "augmented_lagrangian"); show(variation, "augmented_lagrangian:omega=30,xi=0.5"); show(variation, "baumgarte"); });
    let scene = shipped("double_pendulum", &[("theta1_0", 0.1), ("theta2_0", -0.1)]);
    let (q, v) = scene.0.start();
    let state = at_rest(&scene.0, &State { t: 0.0, q: q.to_vec(), v: v.to_vec() }).unwrap();
    println!("{:e}", nalgebra::DVector::from_vec(state.q.clone()));
    let mut variation = state.variation(&scene.0).unwrap();
    println!("M {:e} K {:e} G {:e}", variation.mass(), variation.k(), variation.g());
    for m in ["rcs", "rcs:form=index2", "rcs:form=index1", "rcs:form=ggl", "rcs:solver=gsvd", "rcs:solver=qz"] { show(&mut variation, m); }

    for d in [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1] {
        for w0 in [0.0, 2.0] {
            let phi = std::f64::consts::FRAC_PI_2 + d;
            let scene = shipped("slider_crank_singular", &[("phi0", phi), ("w0", w0)]);
            let (q, v) = scene.0.start();
            match Variation::new(scene.system(), 0.0, q, v) {
                Ok(mut x) => {
                    let sine = x.dynamics.kkt.smallest_sine();
                    let m = linearize(&mut x, &request("mcs", Some(Chart::parse("crank.angle"))));
                    println!("{d:e} {w0}: sine {sine:e} {:?}", m.map(|m| format!("{:?} a {:?}", m.modes.iter().map(|m| m.value).collect::<Vec<_>>(), (m.a[(1,0)], m.a[(1,1)]))).map_err(|e| e.to_string()));
                }
                Err(e) => println!("{d:e} {w0}: {e}"),
            }
        }
    }
}
