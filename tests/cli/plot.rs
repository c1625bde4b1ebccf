use super::*;

/// Reads all of a PNG: width, height.
fn png_size(path: &Path) -> (u32, u32) {
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert!(pixels.iter().any(|value| *value < 60), "nothing is drawn in {}", path.display());
    (info.width, info.height)
}

/// The frames of a GIF, each as its whole picture of palette indices.
fn gif_frames(path: &Path) -> Vec<Vec<u8>> {
    let mut decoder = gif::DecodeOptions::new().read_info(fs::File::open(path).unwrap()).unwrap();
    let width = usize::from(decoder.width());
    let height = usize::from(decoder.height());
    let mut picture = vec![0; width * height];
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (i, index) in frame.buffer.iter().enumerate().filter(|(_, index)| Some(**index) != frame.transparent) {
            let x = i % usize::from(frame.width);
            let y = i / usize::from(frame.width);
            picture[(y + usize::from(frame.top)) * width + x + usize::from(frame.left)] = *index;
        }
        frames.push(picture.clone());
    }
    frames
}

/// Every `name="value"` that follows `start` in a tag.
fn attributes<'a>(svg: &'a str, start: &str, name: &str) -> Vec<&'a str> {
    let tags = svg.split('<').filter(|tag| tag.starts_with(start));
    tags.filter_map(|tag| tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()).collect()
}

/// Points of a path of the form `M x y l dx dy ...`, written as shortly as SVG allows.
fn points(data: &str) -> Vec<(f64, f64)> {
    let mut numbers: Vec<String> = Vec::new();
    let mut open = false;
    for c in data.trim_end_matches('z').chars() {
        let starts = c == '-' || c == '.' && (!open || numbers.last().is_some_and(|last| last.contains('.')));
        match c {
            '0'..='9' | '.' | '-' => {
                if starts || !open {
                    numbers.push(String::new());
                }
                numbers.last_mut().unwrap().push(c);
                open = true;
            }
            _ => open = false,
        }
    }
    let values: Vec<f64> = numbers.iter().map(|number| number.parse().unwrap()).collect();
    let mut at = (0.0, 0.0);
    let step = |pair: &[f64]| {
        at = (at.0 + pair[0], at.1 + pair[1]);
        at
    };
    values.chunks_exact(2).map(step).collect()
}

/// A mass that runs round the origin at a distance of 1 m with 1 m/s: at the angle t.
pub const BOB: &str = r#"{
  "name": "bob", "dimension": 2,
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [{ "name": "bob", "type": "point_mass", "mass": 1,
               "initial": { "position": [1, 0], "velocity": [0, 1] } }],
  "joints": [{ "name": "rod", "type": "distance", "between": ["ground.O", "bob"], "length": 1 }],
  "simulation": { "t_end": 2, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-12 } }"#;

#[test]
fn a_scene_is_drawn_at_its_start_without_a_run() {
    let place = Place::new(PENDULUM.replace("\"t_end\": 1, ", ""));
    let text = place.done(&["plot", "scene.json", "--labels"]);
    assert_eq!(place.files("out/pendulum"), ["mechanism.json", "mechanism.svg"]);
    assert!(
        text.starts_with("pendulum at t = 0 s\n")
            && text.contains("written to out/pendulum: mechanism.svg, mechanism.json"),
        "{text}"
    );
    let svg = place.text("out/pendulum/mechanism.svg");
    assert!(svg.contains("<title>pendulum, t = 0 s</title>") && svg.contains(">rod</text>"));
    assert!(svg.contains(">x (m)</text>") && svg.contains(">y (m)</text>"));
}

#[test]
fn bodies_are_where_they_should_be() {
    let place = Place::new(BOB);
    place.done(&["plot", "scene.json", "--stroboscope", "--at", "1.5,0.25,2", "--trace", "none", "--quiet"]);
    let svg = place.text("out/bob/stroboscope.svg");
    // Rods are lines of this width, from the pivot to the mass; the body turns at 1 rad/s.
    let tags = svg.split('<').filter(|tag| tag.starts_with("path") && tag.contains("stroke-width=\"3\""));
    let rods: Vec<Vec<(f64, f64)>> = tags.map(|tag| points(attributes(&format!("<{tag}"), "path", "d")[0])).collect();
    assert_eq!(rods.len(), 3);
    let lengths: Vec<f64> = rods.iter().map(|rod| (rod[1].0 - rod[0].0).hypot(rod[1].1 - rod[0].1)).collect();
    for (rod, t) in rods.iter().zip([0.25f64, 1.5, 2.0]) {
        let dx = (rod[1].0 - rod[0].0) / lengths[0];
        let dy = (rod[0].1 - rod[1].1) / lengths[0];
        assert!((dx - t.cos()).abs() < 2e-3 && (dy - t.sin()).abs() < 2e-3, "{t}: {dx} {dy}");
    }
    for t in ["0.25", "1.5", "2"] {
        assert!(svg.contains(&format!(">t = {t} s</text>")), "{t}");
    }
}

#[test]
fn figures_are_png_where_asked_for_and_paths_are_drawn() {
    let place = Place::new(PENDULUM);
    let args = ["plot", "scene.json", "--stroboscope", "--frames", "4", "--trace", "rod.A,rod", "--figures", "png"];
    place.done(&args);
    assert_eq!(place.files("out/pendulum"), ["stroboscope.json", "stroboscope.png"]);
    assert_eq!(png_size(&place.path("out/pendulum/stroboscope.png")).0, 1280);
    place.done(&["plot", "scene.json", "--stroboscope", "--trace", "rod", "-o", "here"]);
    assert!(place.text("here/stroboscope.svg").contains(">path of rod</text>"));
}

#[test]
fn an_animation_is_a_gif_whose_frames_differ() {
    let place = Place::new(PENDULUM);
    let args = ["plot", "scene.json", "--animate", "gif", "--fps", "10", "--speed", "0.5", "--labels", "--json"];
    let drawn: Value = serde_json::from_str(&place.done(&args)).unwrap();
    assert_eq!(place.files("out/pendulum"), ["animation.gif", "animation.json"]);
    assert_eq!(drawn["animation"]["frames"], 21);
    assert_eq!(drawn["files"][0], "out/pendulum/animation.gif");
    let frames = gif_frames(&place.path("out/pendulum/animation.gif"));
    assert_eq!((frames.len(), frames[0].len() % 640), (21, 0));
    assert!(frames.windows(2).all(|pair| pair[0] != pair[1]));
    // Axes and title stay: most of the picture is the same from first to last.
    let same = frames[0].iter().zip(&frames[20]).filter(|(a, b)| a == b).count();
    assert!(same > frames[0].len() * 8 / 10);
}

#[test]
fn an_animation_can_be_an_svg() {
    let place = Place::new(BOB);
    place.done(&["plot", "scene.json", "--animate", "svg", "--fps", "5", "--stroboscope", "--quiet"]);
    assert_eq!(place.files("out/bob"), ["animation.json", "animation.svg", "stroboscope.json", "stroboscope.svg"]);
    let svg = place.text("out/bob/animation.svg");
    assert_eq!(svg.matches("<animate ").count(), 11);
    assert_eq!((svg.matches("<g ").count(), svg.matches("</g>").count()), (11, 11));
    assert!(svg.ends_with("</svg>\n") && svg.contains("dur=\"2.2000s\""));
    assert!(svg.contains(">t = 2.0 s</text>") && svg.matches(">x (m)</text>").count() == 1);
}

#[test]
fn spatial_scenes_are_seen_from_where_one_likes() {
    let scene = BOB.replace("\"dimension\": 2", "\"dimension\": 3").replace("[0, 0]", "[0, 0, 0]");
    let place = Place::new(scene.replace("[1, 0]", "[1, 0, 0]").replace("[0, 1]", "[0, 0.6, 0.8]"));
    let mut seen = Vec::new();
    for view in ["iso", "xy", "front", "side", "top", "azimuth=20,elevation=-10"] {
        place.done(&["plot", "scene.json", "--at", "0.7", "--view", view, "--quiet"]);
        seen.push(place.text("out/bob/mechanism.svg"));
    }
    assert!(seen[0].contains("across the view (m)") && seen[2].contains(">z (m)</text>"));
    assert_eq!(seen[1], seen[4], "from the top one sees x and y");
    assert!((0..4).all(|i| (i + 1..4).all(|j| seen[i] != seen[j])));
}

#[test]
fn a_run_that_fails_is_drawn_as_far_as_it_came() {
    // The force has no value after t = 1 s.
    let scene = BOB.replace("\"dop853\"", "\"rk4\", \"step\": 0.01").replace(
        "\"joints\"",
        r#""forces": [{ "name": "blow", "type": "applied_force", "at": "bob", "force": ["1/(t - 1)^3", "sqrt(1 - t)"] }],
           "joints""#,
    );
    let place = Place::new(scene);
    let output = place.run(&["plot", "scene.json", "--stroboscope", "--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let drawn: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!(drawn["status"], "failed");
    assert!(drawn["times"][5].as_f64().unwrap() <= 1.0 && err(&output).contains("error: stopped at t ="));
    assert_eq!(place.files("out/bob"), ["stroboscope.json", "stroboscope.svg"]);
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let place = Place::new(PENDULUM);
    let cases: [(&[&str], &str, &str); 11] = [
        (&["--view", "isometric"], "--view: there is no view `isometric`", "iso"),
        (&["--view", "azimuth=x"], "`x` is no angle", "degrees"),
        (&["--view", "azimut=3"], "a view has no `azimut`", "did you mean `azimuth`?"),
        (&["--view", "xz"], "the scene is planar", "give xy"),
        (&["--stroboscope", "--at", "0,1.5"], "--at: 1.5 s is outside the run", "from 0 s to 1 s"),
        (&["--at", "0,0.5"], "2 times for one figure", "--stroboscope"),
        (&["--stroboscope", "--trace", "rod.B"], "--trace: there is no marker `rod.B`", "did you mean `rod.A`?"),
        (&["--stroboscope", "--figures", "none"], "there is nothing to draw", "svg or png"),
        (&["--animate", "gif", "--speed", "1e-4"], "250001 frames, more than 1000", "--speed"),
        (&["--animate", "gif", "--fps", "80"], "at most 50 frames a second", ""),
        (&["--frames", "5"], "--stroboscope", ""),
    ];
    for (args, message, hint) in cases {
        let output = place.run(&[&["plot", "scene.json"], args].concat());
        let text = err(&output);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""), "{args:?}");
        assert!(text.contains(message) && text.contains(hint), "{args:?}: {text}");
        assert!(!place.path("out").exists(), "{args:?} wrote something");
    }
}
