//! Whether a saved run goes on as the one that went on by itself.

use holonom::simulate::{Checkpoint, Method, Observation, Outcome, Sink, Span, Start, Stop, simulate_from};
use holonom::system::MechanicalSystem;

/// Bits of the accepted states; stops after so many.
struct Bits(Vec<Vec<u64>>, usize);

impl Sink for Bits {
    fn accepted(&mut self, at: &Observation) {
        let all = [at.t, at.work].into_iter().chain([at.q, at.v, at.vdot, at.lambda].concat());
        self.0.push(all.map(f64::to_bits).collect());
    }
    fn stops(&self) -> Option<Stop> {
        (self.0.len() >= self.1).then(|| Stop { reason: "saved".to_string(), hint: String::new() })
    }
}

/// Whether a run that is saved half way, through JSON, and goes on from there differs by a bit.
pub fn differs(system: &dyn MechanicalSystem, method: &Method, span: Span, (q, v): (&[f64], &[f64])) -> bool {
    let carry_on = |start: Start, most: usize| -> (Outcome, Checkpoint, Vec<Vec<u64>>) {
        let mut bits = Bits(Vec::new(), most);
        let (outcome, saved) = simulate_from(system, method, span, start, &mut bits).unwrap();
        let text = serde_json::to_string(&saved.unwrap()).unwrap();
        (outcome, serde_json::from_str(&text).unwrap(), bits.0)
    };
    let (outcome, last, whole) = carry_on(Start::State(q, v), usize::MAX);
    let half = whole.len() / 2;
    let (_, saved, _) = carry_on(Start::State(q, v), half);
    let (resumed, end, rest) = carry_on(Start::Saved(&saved), usize::MAX);
    rest[..] != whole[half - 1..] || end != last || resumed != outcome
}
