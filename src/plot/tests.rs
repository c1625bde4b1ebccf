//! Whole figures: shapes fit and texts are legible for any data.

use std::fs;
use std::path::PathBuf;

use super::shape::{Color, Drawing, Rect, Shape};
use super::text::Rich;
use super::*;

fn wave(count: usize, scale: f64) -> Vec<(f64, f64)> {
    (0..count).map(|k| (k as f64 * 0.01, scale * (k as f64 * 0.05).sin())).collect()
}

fn texts(drawing: &Drawing) -> Vec<Rect> {
    let bounds = |shape: &Shape| if let Shape::Text(text) = shape { Some(text.bounds()) } else { None };
    drawing.shapes.iter().filter_map(bounds).collect()
}

fn assert_readable(name: &str, figure: &Figure) {
    let drawing = figure.drawing();
    let page = Rect::new(0.0, 0.0, drawing.width, drawing.height);
    let texts = texts(&drawing);
    for (index, text) in texts.iter().enumerate() {
        assert!(page.holds(text), "{name}: text {text:?} leaves the page {page:?}");
        let hit = texts[..index].iter().find(|other| other.grown(-1.5).overlaps(&text.grown(-1.5)));
        assert_eq!(hit, None, "{name}: texts overlap at {text:?}");
    }
}

fn panel(x: &str, y: &str) -> Panel {
    Panel::new(x, y).series(Series::line("a", wave(500, 1.0)))
}

fn map() -> HeatMap {
    let mut map = HeatMap::new("largest drift (m)", vec![1.0, 2.0, 3.0], vec![1.0, 2.0]).log();
    map.set(0, 0, 1e-9);
    map.set(1, 0, 1e-3);
    map.set(2, 1, 0.0);
    map.mark(1, 1, "fail");
    map
}

/// A panel with texts along y, and colours from 1e-12 to 1.
fn named_map() -> Panel {
    let mut map = HeatMap::new("drift (m)", vec![1.0, 2.0, 3.0], vec![0.0, 1.0]).log().range(1e-12, 1.0);
    map.set(0, 0, 1e-20);
    map.set(1, 1, 1e3);
    let names = ["none", "manifold"].map(String::from);
    Panel::new("h (s)", AxisSpec::from("projection").names(names)).heat_map(map)
}

#[test]
fn maps_share_colours_and_have_words_along_an_axis() {
    let drawing = Figure::new().panel(named_map()).drawing();
    let words =
        drawing.shapes.iter().filter(|shape| matches!(shape, Shape::Text(text) if text.rich == Rich::new("manifold")));
    assert_eq!(words.count(), 1);
    let fill = |shape: &Shape| if let Shape::Rects { fill, .. } = shape { Some(*fill) } else { None };
    let fills: Vec<Color> = drawing.shapes.iter().filter_map(fill).collect();
    let ends = [0, super::palette::COLOR_STEPS - 1].map(super::palette::scale_color);
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
    let colors =
        ColorSeries::new("time (s)", (0..900).map(|k| (f64::from(k), f64::from(k % 7), 1e-8 * f64::from(k))).collect());
    vec![
        ("plain", Figure::new().title("Plain").panel(panel("time (s)", "angle (rad)"))),
        ("factor", Figure::new().panel(factor(1e-8)).panel(factor(1e8)).panel(log)),
        ("long", Figure::new().title(long.clone()).panel(panel(&long, &long)).panel(panel(&long, &long))),
        ("many", Figure::new().panel(many)),
        ("color", Figure::new().panel(Panel::new("re (1/s)", "im (1/s)").color_series(colors).equal_aspect())),
        ("map", Figure::new().panel(Panel::new("h (s)", "gain").heat_map(map()))),
        ("shared map", Figure::new().panel(named_map()).panel(named_map())),
        (
            "lines",
            Figure::new().panel(panel("x", "y").vertical(0.5, "limit").vertical(2.0, "impact").annotate(1.0, 0.0, "A")),
        ),
        (
            "narrow",
            Figure::new().width(300.0).title("Narrow").panel(panel("time (s)", "a rather long label (kg m²/s²)")),
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
    let colored = (0..4).map(|_| (odd_number(seed), odd_number(seed), odd_number(seed))).collect();
    panel = panel.color_series(ColorSeries::new("c", colored));
    panel = panel.vertical(odd_number(seed), "h").vertical(odd_number(seed), "v");
    panel = panel.annotate(odd_number(seed), odd_number(seed), "note");
    panel.equal_aspect = *seed & (1 << 50) == 0;
    panel.height = (*seed & (1 << 51) == 0).then(|| odd_number(seed)).filter(|height| *height < 1e3);
    if *seed & (1 << 52) == 0 {
        let mut map = HeatMap::new("m", vec![odd_number(seed), odd_number(seed)], vec![odd_number(seed)]);
        map.set(0, 0, odd_number(seed));
        map.mark(7, 7, "outside");
        map.mark(1, 0, "fail");
        panel.heat_map = Some(map);
    }
    panel
}

fn assert_sound(drawing: &Drawing) {
    let finite = |(x, y): &(f64, f64)| x.abs() < 1e5 && y.abs() < 1e5;
    for shape in &drawing.shapes {
        let sound = match shape {
            Shape::Path { points, .. } | Shape::Area { points, .. } => points.iter().all(finite),
            Shape::Marks { at, .. } => at.iter().all(finite),
            Shape::Rects { rects, .. } => {
                rects.iter().all(|r| finite(&(r.left, r.top)) && finite(&(r.right, r.bottom)))
            }
            Shape::Text(text) => finite(&text.at),
        };
        assert!(sound, "{shape:?}");
    }
}

#[test]
fn odd_data_never_panic() {
    let mut seed = 7;
    for round in 0..200 {
        let figure = Figure::new().width(odd_number(&mut seed)).panel(odd_panel(&mut seed)).panel(odd_panel(&mut seed));
        assert_sound(&figure.drawing());
        let svg = figure.to_svg();
        assert!(svg.len() < 300_000 && !svg.contains("NaN") && !svg.contains("inf"), "round {round}");
        if round % 40 == 0 {
            assert!(raster::png(&figure.drawing()).is_ok());
        }
    }
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

/// A folder in the system's one for temporary files, removed when dropped.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("holonom-plot-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the folder").flatten();
        entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn files_are_what_their_names_say_and_always_the_same() {
    let folder = Folder::new("formats");
    let figure = Figure::new().title("a < b & c").panel(panel("time (s)", "x (m)"));
    let [svg, png] = ["f.svg", "f.PNG"].map(|name| folder.0.join(name));
    for _ in 0..2 {
        figure.save(&svg).expect("svg");
        figure.save(&png).expect("png");
    }
    let text = fs::read_to_string(&svg).expect("text");
    assert!(
        text.starts_with("<svg ") && text.ends_with("</svg>\n") && text.contains("<title>a &lt; b &amp; c</title>")
    );
    let bytes = fs::read(&png).expect("bytes");
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((info.width, bytes), (1280, raster::png(&figure.drawing()).expect("the same")));
    assert!(pixels.iter().any(|value| *value < 60) && pixels.contains(&255));
    assert_eq!(folder.names().len(), 2, "no temporary file is left");
}

#[test]
fn bad_paths_are_clear_errors() {
    let folder = Folder::new("errors");
    let figure = Figure::new().panel(panel("x", "y"));
    let message = |path: PathBuf| figure.save(path).expect_err("an error").to_string();
    assert!(message(folder.0.join("f.pdf")).ends_with("f.pdf: the name of a figure must end in .svg or .png"));
    fs::create_dir(folder.0.join("d.svg")).expect("a folder");
    assert!(message(folder.0.join("d.svg")).contains("d.svg: is a directory"));
    assert!(message(folder.0.join("none/f.svg")).contains("none/f.svg: "));
    assert_eq!(folder.names(), ["d.svg"]);
}
