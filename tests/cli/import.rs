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
