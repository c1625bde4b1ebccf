use super::*;

const ROBOT: &str = r#"<robot name="pendulum"><link name="world"/><link name="rod"><inertial><origin xyz="0 0 -0.5"/>
  <mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.01"/></inertial></link>
  <joint name="pin" type="continuous"><parent link="world"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"#;

#[test]
fn a_robot_becomes_a_scene_that_runs() {
    let place = Place::new("");
    fs::write(place.path("robot.urdf"), ROBOT).unwrap();
    place.done(&["import", "robot.urdf", "-o", "made.json"]);
    assert_eq!(place.done(&["import", "robot.urdf"]), place.text("made.json"));
    let check: Value = serde_json::from_str(&place.done(&["check", "made.json", "--json"])).unwrap();
    assert_eq!(check["degrees_of_freedom"], 1);
    place.done(&["simulate", "made.json", "--until", "0.1", "--quiet"]);
}

/// A model in MJCF by the same command; a lone link asks for the option that frees it.
#[test]
fn models_become_scenes_and_a_lone_link_asks_to_be_free() {
    let place = Place::new("");
    fs::write(place.path("four_bar.xml"), include_str!("../data/import/four_bar.xml")).unwrap();
    place.done(&["import", "four_bar.xml", "-o", "made.json"]);
    let check: Value = serde_json::from_str(&place.done(&["check", "made.json", "--json"])).unwrap();
    assert_eq!(check["degrees_of_freedom"], 1);
    fs::write(place.path("craft.urdf"), include_str!("../data/import/one_link.urdf")).unwrap();
    let told = place.command(&["import", "craft.urdf"]).output().unwrap().stderr;
    assert!(String::from_utf8_lossy(&told).contains("--free lets the base"), "{}", String::from_utf8_lossy(&told));
    place.done(&["import", "craft.urdf", "--free", "-o", "free.json"]);
    place.done(&["check", "free.json"]);
}
