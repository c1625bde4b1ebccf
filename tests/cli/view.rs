//! The page of `holonom view`, in a browser where there is one, and the files of glTF.

use super::plot::BOB;
use super::*;
use std::process::Stdio;

/// The data of a page.
fn data(page: &str) -> Value {
    let rest = page.split("id=\"data\">").nth(1).unwrap();
    serde_json::from_str(rest.split("</script>").next().unwrap()).unwrap()
}

/// 32-bit floats in base64.
fn floats(text: &Value) -> Vec<f32> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let text = text.as_str().unwrap().trim_end_matches('=');
    let bits: Vec<u32> = text.bytes().map(|c| u32::from(digit(c))).collect();
    let bytes: Vec<u8> = bits
        .chunks(4)
        .flat_map(|four| {
            let word = (0..4).fold(0, |word, i| word << 6 | four.get(i).copied().unwrap_or(0));
            word.to_be_bytes()[1..four.len()].to_vec()
        })
        .collect();
    bytes.chunks_exact(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect()
}

#[test]
fn a_page_has_the_motion_with_its_curves() {
    let place = Place::new(BOB);
    let text = place.done(&["view", "scene.json", "--rows", "101"]);
    assert!(text.starts_with("bob: a page of ") && text.contains("written to out/bob: view.html, view.json"), "{text}");
    let page = place.text("out/bob/view.html");
    assert!(page.len() < 500_000, "{} bytes", page.len());
    let data = data(&page);
    let clip = &data["mechanisms"][0]["clip"];
    let times = floats(&clip["t"]);
    let poses = floats(&clip["poses"]);
    assert_eq!((times.len(), poses.len()), (101, 303));
    for (t, pose) in times.iter().zip(poses.chunks(3)) {
        // Computed to 1e-10, written with 24 bits.
        assert!((pose[0] - t.cos()).abs() < 3e-7 && (pose[1] - t.sin()).abs() < 3e-7, "{t}: {pose:?}");
    }
    // A mass of 1 kg at 1 m/s on a circle of 1 m pulls its rod with 1 N.
    assert!(floats(&clip["reactions"]).iter().all(|force| (force - 1.0).abs() < 1e-6));
    let curves = data["curves"].as_array().unwrap();
    let names: Vec<&str> = curves.iter().map(|curve| curve["name"].as_str().unwrap()).collect();
    let drift = ["positions |φ|", "velocities |φ′|"];
    assert_eq!(names, [&["bob.x", "bob.y"], &drift[..], &["kinetic", "potential", "total less work"]].concat());
    assert!(floats(&curves[4]["values"]).iter().all(|energy| (energy - 0.5).abs() < 1e-7));
}

#[test]
fn a_finished_run_and_others_are_shown_with_their_parameters() {
    let place = Place::new(
        PENDULUM
            .replace("\"mass\": 1, \"inertia\": \"1/12\"", "\"mass\": \"m\", \"inertia\": \"m/12\"")
            .replace("\"gravity\"", "\"parameters\": { \"m\": 1 }, \"gravity\""),
    );
    place.done(&["simulate", "scene.json", "-o", "one", "--view"]);
    place.done(&["simulate", "scene.json", "--set", "m=3", "-o", "three"]);
    let beside = data(&place.text("one/view.html"));
    place.done(&["view", "scene.json", "--from", "one", "--with", "three", "-o", "both"]);
    let both = data(&place.text("both/view.html"));
    assert_eq!(both["curves"], beside["curves"]);
    let labels: Vec<&str> =
        both["mechanisms"].as_array().unwrap().iter().map(|one| one["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["this run", "three"]);
    let forces = |k: usize| floats(&both["mechanisms"][k]["clip"]["reactions"]);
    for (light, heavy) in forces(0).iter().zip(forces(1)) {
        assert!((3.0 * light - heavy).abs() <= 1e-5 * heavy, "{light} {heavy}");
    }
    let refused = place.run(&["view", "scene.json", "--with", "nowhere"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("--with"), "{}", err(&refused));
}

#[test]
fn a_large_scene_says_what_its_page_leaves_out() {
    let place = Place::new("");
    fs::write(place.path("scene.json"), place.done(&["generate", "n_four_bar", "--n", "200"])).unwrap();
    place.done(&["view", "scene.json", "--until", "0.001", "--rows", "2", "-o", "out"]);
    let page = place.text("out/view.html");
    assert!(page.len() < 500_000, "{} bytes", page.len());
    let data = data(&page);
    let note = data["notes"][0].as_str().unwrap();
    assert!(note.starts_with("the first ") && note.ends_with(" bodies are shown"), "{note}");
    let frames = floats(&data["mechanisms"][0]["clip"]["poses"]).len() / 2 / 3;
    assert!(data["mechanisms"][0]["joints"].as_array().unwrap().iter().all(|joint| {
        joint["ends"].as_array().unwrap().iter().all(|end| end["frame"].as_u64().unwrap() as usize <= frames)
    }));
}

/// The JSON and the binary part of a file of glTF.
fn parsed(file: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&file[..4], word(4), word(8)), (&b"glTF"[..], 2, file.len()));
    let text = word(12);
    assert_eq!(&file[16..20], b"JSON");
    let binary = 20 + text;
    assert_eq!((word(binary), &file[binary + 4..binary + 8]), (file.len() - binary - 8, &b"BIN\0"[..]));
    (serde_json::from_slice(&file[20..binary]).unwrap(), &file[binary + 8..])
}

#[test]
fn a_file_of_gltf_has_the_motion() {
    let place = Place::new(BOB);
    place.done(&["plot", "scene.json", "--gltf"]);
    assert_eq!(place.files("out/bob"), ["motion.glb", "motion.json"]);
    let file = fs::read(place.path("out/bob/motion.glb")).unwrap();
    let (json, binary) = parsed(&file);
    assert_eq!(json["buffers"][0]["byteLength"], binary.len());
    let index = |value: &Value| value.as_u64().unwrap() as usize;
    let size = |kind: &str| match kind {
        "SCALAR" => 1,
        "VEC3" => 3,
        _ => 4,
    };
    let accessor = |number: &Value| {
        let accessor = &json["accessors"][index(number)];
        let view = &json["bufferViews"][index(&accessor["bufferView"])];
        let from = index(&view["byteOffset"]);
        let length = index(&view["byteLength"]);
        let bytes = &binary[from..from + length];
        let of_number = if accessor["componentType"] == 5126 { 4 } else { 2 };
        assert_eq!(length, of_number * index(&accessor["count"]) * size(accessor["type"].as_str().unwrap()));
        bytes.chunks_exact(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect::<Vec<f32>>()
    };
    for mesh in json["meshes"].as_array().unwrap() {
        let primitive = &mesh["primitives"][0];
        assert!(!accessor(&primitive["attributes"]["POSITION"]).is_empty());
        accessor(&primitive["indices"]);
        assert!(index(&primitive["material"]) < json["materials"].as_array().unwrap().len());
    }
    let nodes = json["nodes"].as_array().unwrap();
    let children = nodes.iter().filter_map(|node| node["children"].as_array()).flatten();
    let mut children: Vec<usize> = children.map(index).collect();
    children.sort_unstable();
    assert!(children.into_iter().eq(1..nodes.len()), "each node but the root has one parent");
    let animation = &json["animations"][0];
    let channels = animation["channels"].as_array().unwrap();
    let of_bob = |channel: &&Value| {
        nodes[index(&channel["target"]["node"])]["name"] == "bob" && channel["target"]["path"] == "translation"
    };
    let channel = channels.iter().find(of_bob).unwrap();
    let sampler = &animation["samplers"][index(&channel["sampler"])];
    let times = accessor(&sampler["input"]);
    let places = accessor(&sampler["output"]);
    assert_eq!((times[0], *times.last().unwrap(), places.len()), (0.0, 2.0, 3 * times.len()));
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    for (t, place) in times.iter().zip(places.chunks(3)) {
        assert!((place[0] - t.cos()).abs() < 3e-7 && (place[1] - t.sin()).abs() < 3e-7, "{t}: {place:?}");
    }
}

fn works(program: &str) -> bool {
    let version = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Chromium and the folder with `puppeteer-core`, or what is missing.
fn browser() -> Result<(PathBuf, PathBuf), &'static str> {
    let modules = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/browser/node_modules");
    let chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].into_iter().find(|path| works(path));
    match chromium {
        _ if !modules.join("puppeteer-core").is_dir() => {
            Err("puppeteer-core: `npm ci --prefix target/browser`, as .ci/run does")
        }
        None => Err("Chromium"),
        _ if !works("node") => Err("node"),
        Some(path) => Ok((path.into(), modules)),
    }
}

/// Opens pages in a browser and returns what it found of each.
fn opened(place: &Place, pages: &[&str]) -> Option<Vec<Value>> {
    let (chromium, modules) = match browser() {
        Ok(found) => found,
        Err(missing) => {
            eprintln!("skipped: there is no {missing}");
            return None;
        }
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/view/browser.cjs");
    let mut node = Command::new("node");
    node.arg(script).arg(chromium).args(pages.iter().map(|page| place.path(page))).env("NODE_PATH", modules);
    let output = node.output().unwrap();
    assert!(output.status.success(), "{}", err(&output));
    Some(out(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect())
}

/// A text that tries to run code in the page, and to be taken for its places.
const HOSTILE: &str = "</script><script>alerted=true;alert(1)</script> <!-- /*CODE*/ /*LIBRARIES*/";

#[test]
fn pages_work_in_a_browser() {
    let about = format!("\"about\": \"{HOSTILE}\", \"dimension\"");
    let place = Place::new(PENDULUM.replace("\"dimension\"", &about));
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    // The name of a folder is a text that the page shows, too.
    let ghost = "<img src=x onerror='alerted=true'>";
    place.done(&["simulate", "scene.json", "-o", ghost]);
    place.done(&["view", "scene.json", "--modes", "--with", ghost, "-o", "hostile"]);
    assert!(!place.text("hostile/view.html").contains("alert(1)</script>"));
    let spatial = models.join("tumbling_station.json");
    place.done(&["view", spatial.to_str().unwrap(), "--until", "0.5", "-o", "spatial"]);
    let Some(found) = opened(&place, &["hostile/view.html", "spatial/view.html"]) else { return };
    assert_eq!(found.len(), 2);
    for page in &found {
        assert_eq!((&page["errors"], &page["requests"]), (&Value::Array(vec![]), &Value::Array(vec![])), "{page}");
        assert_eq!(
            (&page["moves"], &page["turns"], &page["finite"]),
            (&true.into(), &true.into(), &true.into()),
            "{page}"
        );
        assert_eq!(page["alerted"], false, "{page}");
        // A click goes to its time within a pixel of about 1000; keys go to the ends, and a step of 1/200.
        assert!((page["clicked"].as_f64().unwrap() - 0.25).abs() < 2e-3, "{page}");
        assert_eq!((&page["home"], &page["end"]), (&0.into(), &1.into()), "{page}");
        assert!((page["step"].as_f64().unwrap() - 0.005).abs() < 1e-6, "{page}");
    }
    assert_eq!(found[0]["modes"]["swings"], true, "{}", found[0]);
    assert_eq!(found[1]["modes"]["labels"], Value::Array(vec![]));
}
