//! The reason why joints cannot be closed.

use super::follow::path;
use super::nearest::{DampedStep, halved};
use super::{Metric, closing, nearest};
use crate::error::{Error, short, significant};
use crate::system::{Group, Prescribed};
use crate::tolerances;
use std::cmp::Reverse;

/// Lengths in a scene that does not close of which some may be in millimetres. Unit: `[1]`, the largest over the
/// smallest. Why: half of a thousand. Test: `millimetres_among_metres_are_named`.
const UNLIKE_LENGTHS: f64 = 500.0;

const OPEN: &str = "the joints cannot all be closed";

/// Finds a joint without which the others close, and moves it as far as they let it. Returns the reason why it stays
/// open; `None` if it is closed that way, with the closed state in q and the way to it in `moved`. The terms of the
/// metric are those of the open state.
pub fn obstacle(
    metric: &mut Metric,
    t: f64,
    guess: &[f64],
    way: &[f64],
    q: &mut Vec<f64>,
    moved: &mut [f64],
) -> Option<Error> {
    if let Some(error) = unlike_lengths(metric) {
        return Some(error);
    }
    let general = general(metric);
    for group in candidates(metric, t) {
        q.copy_from_slice(guess);
        moved.copy_from_slice(way);
        let rows: Vec<usize> = group.rows.clone().collect();
        if !closes_without(metric, &rows, t, q, moved) {
            continue;
        }
        let directions = rotations(metric, &group);
        let has_fitting_axes = directions.is_empty() || directions.len() == rows.len() || {
            let mut turned = guess.to_vec();
            let mut way = way.to_vec();
            !closes_without(metric, &directions, t, &mut turned, &mut way)
        };
        if path(metric, &rows, t, q, moved) == 1.0 {
            return None;
        }
        least_gap(metric, &rows, t, q);
        let is_free = moves(metric, &rows, t, q);
        return Some(blocked(metric, &group, t, is_free, has_fitting_axes));
    }
    Some(general)
}

/// True if the joints close without some rows; then q is the nearest such state.
fn closes_without(metric: &mut Metric, rows: &[usize], t: f64, q: &mut [f64], moved: &mut [f64]) -> bool {
    metric.drop_rows(rows);
    let is_closed = closing::attempt(metric, t, q, moved).unwrap_or(false);
    if is_closed {
        // The closed state is good enough where the nearest is not found.
        let _ = nearest::approach(metric, t, q, moved);
    }
    metric.drop_rows(&[]);
    is_closed
}

/// Moves q, where all joints but one are closed, along these until the gap of that one is least: steps [W G^T; G 0] [d; .]
/// = [-G_r^T phi_r; 0] with its rows r, as long as phi_r + G_r d falls. The terms are those at the end.
fn least_gap(metric: &mut Metric, rows: &[usize], t: f64, q: &mut Vec<f64>) {
    let mut gap = metric.residual(t, q);
    metric.drop_rows(rows);
    for _ in 0..tolerances::APPROACH_STEPS {
        let Some(next) = with_less_gap(metric, rows, t, q, gap) else { break };
        let is_slow = next.1 > (1.0 - tolerances::HALF_OF_THE_DIGITS) * gap;
        (*q, gap) = next;
        if is_slow {
            break;
        }
    }
    metric.drop_rows(&[]);
    metric.residual(t, q);
}

/// True if the other joints let the bodies of some rows move: of an arbitrary direction of motion, a part along the
/// coordinates of these rows is left. At a dead point their gap does not
/// change along it at first. The terms are those at q.
fn moves(metric: &mut Metric, rows: &[usize], t: f64, q: &[f64]) -> bool {
    metric.drop_rows(rows);
    let any: Vec<f64> = (0..metric.still.len()).map(closing::weyl).collect();
    let mut left = Vec::new();
    if metric.at_rest(t, q).is_ok() {
        left = metric.weigh(&any);
        if metric.solve(&mut left, &vec![0.0; metric.terms.phi.len()]).is_err() {
            left.clear();
        }
    }
    let all = metric.largest_along(rows, &any);
    let free = metric.largest_along(rows, &left);
    metric.drop_rows(&[]);
    metric.residual(t, q);
    free > tolerances::ROOT_OF_ROUND_OFF * all
}

/// A closed state whose rows r have a smaller gap than that of q, with that gap.
fn with_less_gap(metric: &mut Metric, rows: &[usize], t: f64, q: &[f64], gap: f64) -> Option<(Vec<f64>, f64)> {
    metric.at_rest(t, q).ok()?;
    let weights: Vec<f64> = rows.iter().map(|row| metric.terms.phi[*row] / metric.scales[*row].powi(2)).collect();
    let slopes = metric.rows_times(rows, &weights);
    let mut d: Vec<f64> = slopes.iter().map(|slope| -slope).collect();
    metric.solve(&mut d, &vec![0.0; metric.terms.phi.len()]).ok()?;
    // Along d, |phi_r|^2/2 falls by d . slopes at first; |G_r d|^2 is its curvature but for that of the constraints.
    let falls: f64 = d.iter().zip(&slopes).map(|(d, slope)| -d * slope).sum();
    let curvature = metric.squared_rates(rows, &d);
    let turn = tolerances::LARGEST_TURN / metric.largest_turn(q, &d);
    let step = DampedStep { d: &d, factor: (falls / curvature).min(turn), most: 2 * tolerances::STEP_HALVINGS };
    let still = metric.still.clone();
    let (ahead, _) = halved(metric, t, q, &still, step, |metric, _| metric.size_of(rows) < gap)?;
    Some((ahead, metric.size_of(rows)))
}

/// Drivers, and joints that are open: drivers first, then those with the fewest rows, and the last in the scene, which close loops.
fn candidates(metric: &Metric, t: f64) -> Vec<Group> {
    let gap = |group: &Group| {
        group.rows.clone().fold(0.0f64, |gap, row| gap.max((metric.terms.phi[row] / metric.scales[row]).abs()))
    };
    let worst = metric.worst(&metric.terms.phi);
    let driven: Vec<usize> = metric.system.prescribed(t).iter().map(|driven| driven.row).collect();
    let is_driven = |group: &Group| group.rows.clone().any(|row| driven.contains(&row));
    let mut open = metric.system.facts().groups();
    // The row of a driver is linear: Newton's method closes it at the cost of the others.
    open.retain(|group| is_driven(group) || gap(group) > tolerances::UNSEEN * worst);
    open.sort_by_key(|group| (!is_driven(group), group.rows.len(), Reverse(group.rows.start)));
    // Each is dropped in turn to see whether the others close.
    open.truncate(8);
    open
}

/// The rows of a joint that are angles.
fn rotations(metric: &Metric, group: &Group) -> Vec<usize> {
    let names = metric.system.facts().names.lambda.clone();
    group.rows.clone().filter(|row| !is_length(&names[*row])).collect()
}

/// True if a row of this name is in metres.
pub(super) fn is_length(row: &str) -> bool {
    ["x", "y", "z", "length"].contains(&row.rsplit('.').next().unwrap_or(row))
}

/// The error for a joint whose gap is least where the terms are.
fn blocked(metric: &Metric, group: &Group, t: f64, is_free: bool, has_fitting_axes: bool) -> Error {
    let Group { name, rows, .. } = group;
    let directions = rotations(metric, group);
    let size =
        |rows: &mut dyn Iterator<Item = usize>| rows.map(|row| metric.terms.phi[row].powi(2)).sum::<f64>().sqrt();
    let turned = size(&mut directions.iter().copied());
    let apart = size(&mut rows.clone().filter(|row| !directions.contains(row)));
    let gap = if apart > 0.0 { format!("{} m", short(apart)) } else { format!("{} rad", short(turned)) };
    let error = |text: String| Error::input(format!("{OPEN}: {text}")).under("joints").element(name);
    if let Some(text) = metric.system.prescribed(t).iter().find_map(|driven| beyond(metric, group, driven)) {
        return error(text).hint("let the driver stay within its travel, or start nearer");
    }
    if !has_fitting_axes {
        let degrees = turned.min(1.0).asin().to_degrees();
        let text = format!("the axes of `{name}` do not fit: they stay {} degrees apart", short(degrees));
        return error(text).hint("turn a marker of this joint, or take one with more freedoms, such as `spherical`");
    }
    let equations = metric.terms.phi.len();
    if !is_free {
        let text = format!(
            "`{name}` is one joint too many: the others leave no freedom to close its gap of {gap} ({equations} equations, \
             {} velocities)",
            metric.still.len()
        );
        return error(text).hint("remove a joint, or take one with more freedoms; or mend its lengths and markers");
    }
    error(format!("`{name}` is out of reach, by {gap}")).hint(reach_hint(metric))
}

/// The text for a driver that asks for more than its joints reach.
fn beyond(metric: &Metric, group: &Group, driven: &Prescribed) -> Option<String> {
    let value = driven.value.filter(|_| group.rows.contains(&driven.row))?;
    let unit = if is_length(&metric.system.facts().names.lambda[driven.row]) { "m" } else { "rad" };
    let reached = value + metric.terms.phi[driven.row];
    let value = significant(value, tolerances::DIGITS_OF_TRAVEL);
    let reached = significant(reached, tolerances::DIGITS_OF_TRAVEL);
    Some(format!("the driver `{}` asks for {value} {unit}, and the joints reach {reached} {unit}", group.name))
}

fn reach_hint(metric: &Metric) -> &'static str {
    if metric.held.is_empty() {
        "check lengths and markers of these joints, and whether one asks for what another forbids; or start nearer"
    } else {
        "check lengths and markers of these joints, or hold fewer coordinates in assembly.hold"
    }
}

/// The error where one joint is not to blame.
fn general(metric: &Metric) -> Error {
    let culprits = metric.culprits(&metric.terms.phi);
    Error::input(format!("{OPEN}; gaps that remain (m, rad): {culprits}")).under("joints").hint(reach_hint(metric))
}

/// The error for lengths of which some may be in millimetres.
fn unlike_lengths(metric: &Metric) -> Option<Error> {
    let lengths = metric.system.facts().lengths.clone();
    let (long, most) = lengths.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let (brief, least) = lengths.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    if *most < UNLIKE_LENGTHS * least {
        return None;
    }
    let text = format!(
        "{OPEN}: the longest part, `{long}` with {} m, is {} times as long as `{brief}` with {} m",
        short(*most),
        short(most / least),
        short(*least)
    );
    Some(Error::input(text).under("bodies").hint("give all lengths in metres; millimetres in some of them are likely"))
}

/// The error for values in `initial` that the joints do not allow.
pub fn refused_values(metric: &Metric) -> Error {
    let culprits = metric.culprits(&metric.terms.phi);
    Error::input(format!(
        "the joints cannot be closed with the coordinates in `initial`; gaps that remain (m, rad): {culprits}"
    ))
    .under("initial")
    .hint("give values that the joints allow together, or fewer of them; or let the bodies start nearer")
}
