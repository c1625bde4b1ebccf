//! Assembly closes what can be closed, and says of the rest what is in the way.

mod diagnosis;
mod loops;
mod sizes;

use holonom::initial::Assembly;
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use serde_json::Value;

fn prepared(scene: &str) -> holonom::Result<Model> {
    Model::new(Scene::parse(scene, &[])?, &Overrides::default())
}

fn assembled(scene: &Value) -> holonom::Result<Assembly> {
    Ok(prepared(&scene.to_string())?.assembly)
}
