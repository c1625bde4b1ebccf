//! The figure of a frequency response.

use super::Response;
use super::phase::phases;
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::report::figures::{grouped, label};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Magnitude {
    /// 20 log10 |H| of |H| in units of the output per unit of the input.
    Decibel,
    /// |H| on a logarithmic axis.
    Absolute,
}

/// Lines in a panel at most: as many as there are colours.
const LINES: usize = 7;

/// Responses to one input in one unit.
type ResponseGroup<'a> = Vec<&'a Response>;

/// Returns the responses by input and unit, those that are zero left out.
fn groups(responses: &[Response]) -> Vec<ResponseGroup<'_>> {
    grouped(responses.iter().filter(|response| !response.is_zero()), |response| (&response.input, response.unit()))
}

/// True for each group that is drawn: the first of each input, then the second of each ...
fn drawn(groups: &[ResponseGroup]) -> Vec<bool> {
    let rank = |place: usize| groups[..place].iter().filter(|group| group[0].input == groups[place][0].input).count();
    let mut order: Vec<usize> = (0..groups.len()).collect();
    order.sort_by_key(|&place| rank(place));
    let mut drawn = vec![false; groups.len()];
    order.into_iter().take(8).for_each(|place| drawn[place] = true);
    drawn
}

/// Returns the responses that are not zero and for which a figure has no room.
pub fn not_drawn(responses: &[Response]) -> Vec<&Response> {
    let groups = groups(responses);
    let drawn = drawn(&groups);
    let rest = groups.into_iter().zip(drawn);
    rest.flat_map(|(group, drawn)| group.into_iter().skip(if drawn { LINES } else { 0 })).collect()
}

/// Draws magnitude and phase over frequencies in Hz, side by side for each input and unit; one response alone in one
/// column. `None` without a response that is not zero.
pub fn bode_figure(title: &str, frequencies: &[f64], responses: &[Response], magnitude: Magnitude) -> Option<Figure> {
    let groups = groups(responses);
    let first = groups.first().filter(|_| !frequencies.is_empty())?;
    if let ([group], [only]) = (&groups[..], &first[..]) {
        let [sizes, phases] = panels(group, frequencies, magnitude, |_| String::new());
        let title = format!("{title}: {} over {}", only.output, only.input);
        return Some(Figure::new().title(title).panel(sizes).panel(phases));
    }
    let input = &first[0].input;
    let has_one_input = groups.iter().all(|group| group[0].input == *input);
    let title = if has_one_input { format!("{title}: response to {input}") } else { title.to_string() };
    let figure = Figure { columns: 2, width: 1100.0, ..Figure::new().title(title) };
    let shown = groups.iter().zip(drawn(&groups)).filter(|(_, drawn)| *drawn);
    Some(shown.fold(figure, |figure, (group, _)| {
        let [mut sizes, phases] = panels(group, frequencies, magnitude, |response| response.output.clone());
        if !has_one_input {
            sizes = sizes.title(format!("response to {}", group[0].input));
        }
        figure.panel(sizes).panel(phases)
    }))
}

/// Returns the panels of magnitudes and of phases; the first has the names.
fn panels(
    group: &ResponseGroup,
    frequencies: &[f64],
    magnitude: Magnitude,
    name: impl Fn(&Response) -> String,
) -> [Panel; 2] {
    let lines = |y: AxisSpec, name: &dyn Fn(&Response) -> String, values: &dyn Fn(&Response) -> Vec<f64>| {
        let line = |response: &&Response| {
            let points = frequencies.iter().copied().zip(values(response)).collect();
            Series::line(name(response), points)
        };
        let panel = Panel::new(AxisSpec::from("frequency (Hz)").log(), y);
        group.iter().take(LINES).map(line).fold(panel, Panel::series)
    };
    let sizes = lines(magnitude.axis(&group[0].unit()), &name, &|response| magnitude.of(response));
    let phases = |response: &Response| phases(frequencies, &response.values);
    [sizes, lines(AxisSpec { is_angle: true, ..AxisSpec::from("phase (deg)") }, &|_| String::new(), &phases)]
}

impl Magnitude {
    fn axis(self, unit: &str) -> AxisSpec {
        match self {
            Magnitude::Decibel if unit.is_empty() => AxisSpec::from("magnitude (dB)"),
            Magnitude::Decibel => AxisSpec::from(format!("magnitude (dB re {unit})")),
            Magnitude::Absolute => AxisSpec::from(label("magnitude", unit)).log(),
        }
    }

    /// Returns magnitudes; zero has no place on either axis and becomes NaN.
    fn of(self, response: &Response) -> Vec<f64> {
        let size = |size: f64| match self {
            _ if size <= 0.0 => f64::NAN,
            Magnitude::Decibel => 20.0 * size.log10(),
            Magnitude::Absolute => size,
        };
        response.values.iter().map(|value| size(value.norm())).collect()
    }
}
