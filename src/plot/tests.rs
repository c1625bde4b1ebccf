//! Whole figures: shapes fit and texts are legible for any data.

use super::*;

fn wave(count: usize, scale: f64) -> Vec<(f64, f64)> {
    (0..count).map(|k| (k as f64 * 0.01, scale * (k as f64 * 0.05).sin())).collect()
}

fn texts(drawing: &Drawing) -> Vec<Rect> {
    let bounds = |shape: &Shape| if let Shape::Text(text) = shape { Some(text.bounds()) } else { None };
    drawing.shapes.iter().filter_map(bounds).collect()
}

fn overlap(a: &Rect, b: &Rect) -> bool {
    a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
}

fn assert_readable(name: &str, figure: &Figure) {
    let drawing = draw::figure(figure);
    let page = Rect::new((0.0, 0.0), (drawing.width, drawing.height));
    let texts = texts(&drawing);
    for (index, text) in texts.iter().enumerate() {
        assert!(
            text.corners().iter().all(|corner| page.contains(*corner)),
            "{name}: text {text:?} leaves the page {page:?}"
        );
        let hit = texts[..index].iter().find(|other| overlap(&other.grown(-1.5), &text.grown(-1.5)));
        assert_eq!(hit, None, "{name}: texts overlap at {text:?}");
    }
}

fn panel(x: &str, y: &str) -> Panel {
    Panel::new(x, y).series(Series::line("a", wave(500, 1.0)))
}

/// Adds a line of a sweep.
fn vertical(panel: Panel, x: f64, text: &str) -> Panel {
    let spots = [f64::NEG_INFINITY, f64::INFINITY].map(|y| Spot::data(x, y)).to_vec();
    panel.items([Item { spots, tint: Tint::Ink(0.3), form: ItemForm::Line(1.5, true) }]).note(
        Tint::Ink(0.25),
        x,
        f64::INFINITY,
        text,
    )
}

/// A point coloured by a value.
fn dot(x: f64, y: f64, value: f64) -> Item {
    Item { spots: vec![Spot::data(x, y)], tint: Tint::Value(value), form: ItemForm::Disc(2.7) }
}

/// A cell of a map around a point.
fn cell(x: f64, y: f64, value: f64) -> Item {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let spots = corners.map(|(right, up)| Spot::data(x + right, y + up)).to_vec();
    Item { spots, tint: Tint::Value(value), form: ItemForm::Cell }
}

/// A panel with texts along both axes, and colours from 1e-12 to 1.
fn map() -> Panel {
    let cells = [(0.0, 0.0, 1e-20), (1.0, 1.0, 1e3), (2.0, 1.0, 0.0)];
    let named = |label: &str, names: [&str; 3]| AxisSpec {
        names: names.map(String::from).to_vec(),
        ..AxisSpec::from(label).range(-0.5, 2.5)
    };
    let mut panel =
        Panel::new(named("h (s)", ["0.1", "0.2", "0.4"]), named("projection", ["none", "manifold", "both"]));
    panel.colors = AxisSpec::from("largest drift (m)").log().range(1e-12, 1.0);
    panel.items(cells.map(|(x, y, value)| cell(x, y, value)))
}

#[test]
fn maps_share_colours_and_have_words_along_an_axis() {
    let drawing = draw::figure(&Figure::new().panel(map()));
    let words =
        drawing.shapes.iter().filter(|shape| matches!(shape, Shape::Text(text) if text.rich == Rich::new("manifold")));
    assert_eq!(words.count(), 1);
    let fill = |shape: &Shape| if let Shape::Drawn(Paint::Area(fill, ..), _) = shape { Some(*fill) } else { None };
    let fills: Vec<Color> = drawing.shapes.iter().filter_map(fill).collect();
    let ends = [0, COLOR_STEPS - 1].map(scale_color);
    assert!(ends.iter().all(|end| fills.contains(end)), "{fills:?}");
}

fn samples() -> Vec<(&'static str, Figure)> {
    let factor = |scale: f64| Panel::new("time (s)", "energy (J)").series(Series::line("E", wave(500, scale)));
    let log = Panel::new("time (s)", AxisSpec::from("drift (m)").log()).series(Series::line("a", wave(500, 1e-9)));
    let long = "words ".repeat(60);
    let mut many = Panel::new("t (s)", "q");
    for k in 0..23 {
        many = many.series(Series::line(format!("series {k} {long}"), wave(300, k as f64)));
    }
    let mut colors = Panel { equal_aspect: true, ..Panel::new("re (1/s)", "im (1/s)") };
    colors.colors = "time (s)".into();
    let colors = colors.items((0..900).map(|k| dot(f64::from(k), f64::from(k % 7), 1e-8 * f64::from(k))));
    vec![
        ("plain", Figure::new().title("Plain").panel(panel("time (s)", "angle (rad)"))),
        ("factor", Figure::new().panel(factor(1e-8)).panel(factor(1e8)).panel(log)),
        ("long", Figure::new().title(long.clone()).panel(panel(&long, &long)).panel(panel(&long, &long))),
        ("many", Figure::new().panel(many)),
        ("color", Figure::new().panel(colors)),
        ("map", Figure::new().panel(map())),
        ("shared map", Figure::new().panel(map()).panel(map())),
        (
            "lines",
            Figure::new().panel(vertical(vertical(panel("x", "y"), 0.5, "limit"), 2.0, "impact").note(
                Tint::Ink(0.0),
                1.0,
                0.0,
                "A",
            )),
        ),
        (
            "narrow",
            Figure { width: 300.0, ..Figure::new().title("Narrow") }
                .panel(panel("time (s)", "a rather long label (kg m²/s²)")),
        ),
        (
            "tiny time",
            Figure::new()
                .panel(Panel::new("time (s)", "x (m)").series(Series::line("x", vec![(0.0, 1.0), (3e-7, 2.0)]))),
        ),
        ("empty", Figure::new().panel(Panel::new("x", "y")).panel(Panel::default())),
    ]
}

#[test]
fn texts_neither_overlap_nor_leave_the_page() {
    for (name, figure) in samples() {
        assert_readable(name, &figure);
    }
}

/// Returns numbers that break naive plots, in an order that a seed decides.
fn odd_number(seed: &mut u64) -> f64 {
    const ODD: [f64; 17] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e-300,
        1e300,
        -1e300,
        f64::MAX,
        f64::MIN,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        5e-324,
        1e-9,
        19.62,
        19.620_000_001,
        3.5e7,
    ];
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    ODD[(*seed >> 33) as usize % ODD.len()]
}

fn odd_panel(seed: &mut u64) -> Panel {
    let axis = |seed: &mut u64, label: &str| {
        let spec = AxisSpec::from(label).range(odd_number(seed), odd_number(seed));
        let spec = if *seed & (1 << 40) == 0 { AxisSpec { range: None, ..spec } } else { spec };
        if *seed & (1 << 41) == 0 { spec.log() } else { spec }
    };
    let mut panel = Panel::new(axis(seed, "x ₁"), axis(seed, "y \u{0}<&>\u{ffff}"));
    for style in [Style::Line, Style::Dashed, Style::Dots, Style::LineDots] {
        let count = (*seed >> 45) as usize % 12;
        let points = (0..count).map(|_| (odd_number(seed), odd_number(seed))).collect();
        panel = panel.series(Series::line(format!("s{count}"), points).style(style));
    }
    panel = panel.items((0..4).map(|_| dot(odd_number(seed), odd_number(seed), odd_number(seed))));
    panel.colors = axis(seed, "c");
    panel = vertical(vertical(panel, odd_number(seed), "h"), odd_number(seed), "v");
    panel = panel.note(Tint::Ink(1.0), odd_number(seed), odd_number(seed), "note");
    panel.equal_aspect = *seed & (1 << 50) == 0;
    panel.height = (*seed & (1 << 51) == 0).then(|| odd_number(seed)).filter(|height| *height < 1e3);
    if *seed & (1 << 52) == 0 {
        panel = panel.items([0.0, 1.0, 7.0].map(|x| cell(x, 0.0, odd_number(seed))));
    }
    panel
}

fn assert_sound(drawing: &Drawing) {
    let finite = |(x, y): &(f64, f64)| x.abs() < 1e5 && y.abs() < 1e5;
    for shape in &drawing.shapes {
        let sound = match shape {
            Shape::Drawn(_, lines) => lines.iter().flatten().all(finite),
            Shape::Text(text) => finite(&text.at),
        };
        assert!(sound, "{shape:?}");
    }
}

#[test]
fn odd_data_never_panic() {
    let mut seed = 7;
    for round in 0..200 {
        let mut figure = Figure { width: odd_number(&mut seed), columns: [1, 1, 2, 40][round % 4], ..Figure::new() };
        (0..if round % 4 == 3 { 40 } else { 2 }).for_each(|_| figure.panels.push(odd_panel(&mut seed)));
        assert_sound(&draw::figure(&figure));
        let svg = figure.to_svg();
        assert!(
            svg.len() < 150_000 * figure.panels.len() && !svg.contains("NaN") && !svg.contains("inf"),
            "round {round}"
        );
        if round % 40 == 0 {
            assert!(figure.to_png().is_ok());
        }
    }
}

type Points = Vec<(f64, f64)>;

/// Returns data of a kind: none, one point, equal ones, huge ones, with gaps, usual ones.
fn kinds_of_data() -> Vec<(&'static str, Points)> {
    let wild = |value: f64| (0..40).map(|k| (f64::from(k), if k % 3 == 1 { value } else { f64::from(k) })).collect();
    vec![
        ("empty", Vec::new()),
        ("single", vec![(1.0, 2.0)]),
        ("equal", vec![(3.0, 3.0); 20]),
        ("huge", wild(1e300)),
        ("huge negative", wild(-1e300)),
        ("nan", wild(f64::NAN)),
        ("infinite", wild(f64::INFINITY)),
        ("nothing but nan", vec![(f64::NAN, f64::NAN); 3]),
        ("usual", wave(300, 1.0)),
    ]
}

fn spots(points: &Points) -> Vec<Spot> {
    points.iter().map(|(x, y)| Spot::data(*x, *y).moved(3.0, -2.0)).collect()
}

/// Returns the items of a mechanism at these points.
fn mechanism(points: &Points) -> Panel {
    let item = |spots, form| Item { spots, tint: Tint::Body(1, 0.3), form };
    let line = item(spots(points), ItemForm::Line(1.5, true));
    let area = item(spots(points), ItemForm::Area(0.5));
    let discs = spots(points).into_iter().map(|spot| item(vec![spot], ItemForm::Disc(4.0)));
    let text = |spot| item(vec![spot], ItemForm::Text("body".into(), Align::Start));
    let corner = Spot::data(f64::INFINITY, f64::INFINITY).moved(0.0, 9.0);
    let texts = spots(points).into_iter().chain([corner]).map(text);
    let axis = item(vec![corner.moved(-40.0, -40.0), corner.moved(-20.0, -40.0)], ItemForm::Line(1.0, false));
    let items = discs.chain([area, line, axis]).chain(texts);
    let keys = vec![("t = 0 s".into(), Tint::Ink(0.5))];
    Panel { equal_aspect: true, keys, ..Panel::new("x (m)", "y (m)") }.items(items)
}

/// Returns a figure of each kind that the program draws, of the same data.
fn kinds_of_figures(points: &Points) -> Vec<(&'static str, Figure)> {
    let line = |style: Style| Series::line("a", points.clone()).style(style);
    let log = |label: &str| AxisSpec::from(label).log();
    let lines = Panel::new("time (s)", "angle (rad)").series(line(Style::Line)).series(line(Style::Dashed));
    let loci = Panel::new("real part (1/s)", "imaginary part (rad/s)");
    let loci =
        loci.items(points.iter().map(|(x, y)| dot(*x, *y, *y))).series(line(Style::Crosses)).series(line(Style::Guide));
    let work = Panel::new(log("CPU time (s)"), log("error")).series(line(Style::LineDots)).note(
        Tint::Ink(0.0),
        1.0,
        1.0,
        "1e-6",
    );
    let magnitude = Panel::new(log("frequency (rad/s)"), log("magnitude")).series(line(Style::Line));
    let phase = Panel::new(log("frequency (rad/s)"), AxisSpec { is_angle: true, ..AxisSpec::from("phase (°)") })
        .series(line(Style::Thin));
    let campbell = Panel::new("speed (rad/s)", "frequency (rad/s)").series(line(Style::Dotted));
    let campbell = vertical(campbell, 1.0, "unstable");
    let sweep = Panel::new("stiffness (N/m)", "steps").series(line(Style::Dots));
    let cells = points.iter().enumerate().map(|(row, (_, value))| cell(1.0, row as f64, *value));
    let map = Panel { items: cells.collect(), ..map() };
    vec![
        ("lines", Figure::new().title("Lines").panel(lines.clone())),
        ("loci", Figure::new().panel(loci)),
        ("work", Figure { columns: 2, ..Figure::new().panel(work.clone()).panel(work) }),
        ("stability", Figure::new().panel(map)),
        ("outputs", Figure::new().panel(lines.clone()).panel(lines.clone()).panel(lines)),
        ("bode", Figure::new().panel(magnitude).panel(phase)),
        ("campbell", Figure::new().panel(campbell)),
        ("sweep", Figure::new().panel(sweep)),
        ("mechanism", Figure::new().panel(mechanism(points))),
        (
            "modes",
            Figure { columns: 2, ..Figure::new().panel(mechanism(points).title("mode 1")).panel(mechanism(points)) },
        ),
    ]
}

/// Returns the range of the shapes that data made: between the grid and the frame, which have styles of their own.
fn data_shapes(drawing: &Drawing) -> &[Shape] {
    let is = |shape: &Shape, stroke| matches!(shape, Shape::Drawn(Paint::Line(same), _) if *same == stroke);
    let first = drawing.shapes.iter().position(|shape| is(shape, GRID)).map_or(0, |grid| grid + 1);
    let last = drawing.shapes.iter().position(|shape| is(shape, FRAME)).unwrap_or(first);
    &drawing.shapes[first.min(last)..last]
}

#[test]
fn each_kind_of_figure_takes_any_data() {
    for (data, points) in kinds_of_data() {
        for (kind, figure) in kinds_of_figures(&points) {
            let drawing = draw::figure(&figure);
            assert_sound(&drawing);
            let frame = drawing.shapes.iter().find_map(|shape| match shape {
                Shape::Drawn(Paint::Line(stroke), lines) if *stroke == FRAME => {
                    lines.iter().find(|line| line.len() == 5)
                }
                _ => None,
            });
            let frame = frame.unwrap_or_else(|| panic!("{kind} of {data} data has no frame"));
            let reach = if ["mechanism", "modes"].contains(&kind) { 30.0 } else { 1.0 };
            let inside = Rect { left: frame[0].0, top: frame[0].1, right: frame[2].0, bottom: frame[2].1 }.grown(reach);
            if figure.panels.len() == 1 {
                for shape in data_shapes(&drawing) {
                    let Shape::Drawn(paint, lines) = shape else { continue };
                    let outlying = lines.iter().flatten().find(|point| !inside.contains(**point));
                    // Markers reach beyond the frame by their size.
                    let is_marker = matches!(paint, Paint::Area(..)) && lines.iter().all(|line| line.len() < 6);
                    assert!(outlying.is_none() || is_marker, "{kind} of {data} data: {outlying:?} outside {inside:?}");
                }
            }
            let svg = figure.to_svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{kind} of {data} data");
            assert!(figure.to_png().is_ok(), "{kind} of {data} data");
        }
    }
}

#[test]
fn animations_take_any_data() {
    for (data, points) in kinds_of_data() {
        let frame = |k: usize| Figure::new().panel(mechanism(&points).title(format!("{k}")));
        let animation = Animation { frame, count: 3, per_second: 25.0 };
        let (svg, mut drawn) = (animation.to_svg(), 0);
        assert!(svg.matches("<animate ").count() == 3 && !svg.contains("NaN"), "{data}");
        let gif = animation.to_gif(|count| drawn = count).expect("a GIF");
        assert!(gif.starts_with(b"GIF89a") && drawn == 3, "{data}");
    }
}

/// A value far outside a fixed range is cut off, and does not become a peak at the frame.
#[test]
fn spikes_are_cut_off_at_the_frame() {
    let points = vec![(0.0, 0.5), (1.0, 0.5), (2.0, 1e300), (3.0, 0.5), (4.0, f64::NAN), (5.0, 0.5), (6.0, 0.5)];
    let panel = Panel::new("x", AxisSpec::from("y").range(0.0, 1.0)).series(Series::line("", points));
    let drawing = draw::figure(&Figure::new().panel(panel));
    let lines = data_shapes(&drawing).iter().find_map(|shape| match shape {
        Shape::Drawn(Paint::Line(stroke), lines) if *stroke != FRAME => Some(lines),
        _ => None,
    });
    let lines = lines.expect("the line");
    // Before the spike, after it, and after the gap; the spike is as narrow as it is high, so that no peak is seen at 2.
    let ends: Vec<[f64; 2]> = lines.iter().map(|line| [line[0].0, line[line.len() - 1].0]).collect();
    let [before, after, last] = ends[..] else { panic!("{lines:?}") };
    let unit = last[1] - last[0];
    assert!((before[1] - before[0] - unit).abs() < 0.1 && (after[0] - before[1] - 2.0 * unit).abs() < 0.1, "{lines:?}");
    assert!((after[1] - after[0]).abs() < 0.1 && last[0] - after[1] > 1.9 * unit, "{lines:?}");
}

#[test]
fn units_are_set_with_superscripts() {
    let svg = Figure::new().panel(panel("time (s)", "acceleration (m/s^2)")).to_svg();
    assert!(!svg.contains('^') && svg.contains(">2</tspan>"), "{svg}");
}

#[test]
fn long_data_make_small_files() {
    let noise = |seed: u64| {
        let mut state = seed;
        let point = move |k: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(seed);
            (f64::from(k) * 1e-3, (state >> 40) as f64)
        };
        (0..100_000).map(point).collect::<Vec<_>>()
    };
    let mut figure = Figure::new();
    for row in 0..3 {
        let lines = (0..7).map(|k| Series::line(format!("{k}"), noise(2 * (7 * row + k) + 1)));
        figure = figure.panel(Panel { series: lines.collect(), ..Panel::new("t (s)", "noise") });
    }
    assert!(figure.to_svg().len() < 300_000, "{}", figure.to_svg().len());
    let dots = Figure::new().panel(Panel::new("t", "y").series(Series::dots("d", noise(3))));
    assert!(dots.to_svg().len() < 300_000, "{}", dots.to_svg().len());
}

#[test]
fn files_are_what_their_names_say_and_always_the_same() {
    let figure = Figure::new().title("a < b & c").panel(panel("time (s)", "x (m)"));
    let text = figure.to_svg();
    assert!(
        text.starts_with("<svg ") && text.ends_with("</svg>\n") && text.contains("<title>a &lt; b &amp; c</title>")
    );
    let bytes = figure.to_png().expect("bytes");
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((info.width, bytes), (1280, figure.to_png().expect("the same")));
    assert_eq!(text, figure.to_svg());
    assert!(pixels.iter().any(|value| *value < 60) && pixels.contains(&255));
}
