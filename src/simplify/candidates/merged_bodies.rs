//! Two bodies that hardly move against each other.

use super::absorbed::{Absorbed, absorb, markers};
use super::plane::combined;
use crate::body::{dot, sub};
use crate::error::percent;
use crate::math::array::{Each, from_fn};
use crate::math::expression::Parameters;
use crate::scene::document::{carrier, elements, find_mut, number as written, pair, remove, text, value};
use crate::simplify::{Candidate, Facts, PlacedMarker, Proposal, Relative};
use serde_json::{Value, json};

/// Two rigid bodies that a joint connects become one, as they are to each other at the start: joints between the two
/// go. Its mass and inertia are sums in the numbers of the scene; where its centre is stays as the numbers are. By
/// their motion against each other, which a weld does not let them have.
pub struct MergedBodies;

impl Candidate for MergedBodies {
    fn name(&self) -> &'static str {
        "merged_bodies"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let travel = facts.travel();
        let pairs = elements(facts.scene(), "joints").iter().filter_map(pair).map(|pair| pair.map(carrier));
        pairs.filter_map(|pair| proposal(facts, pair, &travel)).collect()
    }
}

fn proposal(facts: &Facts, names: [&str; 2], travel: &Relative) -> Option<Proposal> {
    // The heavier one is that to which others are added.
    let mass = |name: &str| facts.number(&facts.element("bodies", name)?["mass"]);
    let [first, second] = if mass(names[0])? < mass(names[1])? { [names[1], names[0]] } else { names };
    let merged = Merged::new(facts, [first, second])?;
    let effect = facts.relative(first, second)?.part(travel);
    Some(Proposal {
        subject: format!("{first}, {second}"),
        what: format!("{first} and {second} become one body"),
        why: format!("they move against each other by {} of what bodies do", percent(effect)),
        effect,
        edit: Box::new(move |scene| merged.replace(scene)),
    })
}

/// A body to which a second one is added.
struct Merged {
    first: String,
    /// Start of the first as assembled, which would share its motion alone among both.
    initial: Value,
    /// The second, as it is in the full model.
    second: Value,
    /// Place of the second in the frame of the first.
    place: PlacedMarker,
    /// Markers of the second.
    markers: Vec<Absorbed>,
    dimension: usize,
    /// Numbers of the scene.
    parameters: Parameters,
}

impl Merged {
    fn new(facts: &Facts, names: [&str; 2]) -> Option<Merged> {
        let is_free = |body: &Value| text(body, "type") == "rigid" && body.get("free").is_none();
        let of =
            |name: &str| facts.element("bodies", name).filter(|body| is_free(body) && body.get("inertia").is_some());
        let [_, second] = [of(names[0])?, of(names[1])?];
        let base = facts.place(names[0])?;
        let place = |marker: &str| Some(seen(&base, &facts.place(marker)?));
        let markers = markers(second, |marker| Some(place(marker)?.marker(facts.dimension())))?;
        Some(Merged {
            first: names[0].to_string(),
            initial: facts.initial(names[0])?,
            second: second.clone(),
            place: place(names[1])?,
            markers,
            dimension: facts.dimension(),
            parameters: facts.prepared.parameters.clone(),
        })
    }

    fn replace(&self, scene: &mut Value) -> Result<(), String> {
        let first = &self.first;
        let second = text(&self.second, "name");
        if find_mut(scene, "bodies", second)? != &self.second {
            return Err(format!("`{second}` is no longer what it was"));
        }
        let total = format!("{first}_{second}_mass");
        let own = find_mut(scene, "bodies", first)?;
        let mass = self.add(own, &total).ok_or_else(|| format!("`{first}` is no longer what it was"))?;
        scene["parameters"][total] = mass;
        remove(scene, "bodies", |body| text(body, "name") == second);
        absorb(scene, &self.markers, first);
        Ok(())
    }
}

impl Merged {
    /// Adds the second body to `body`, in the numbers of the scene, by the theorem of parallel axes; the parameter
    /// `total` is to be the mass that is returned.
    fn add(&self, body: &mut Value, total: &str) -> Option<Value> {
        let number = |number: &Value| value(number, &self.parameters);
        let origin = |body: &Value| -> [f64; 3] { from_fn(|i| number(&body["origin"][i]).unwrap_or(0.0)) };
        let masses = [body["mass"].clone(), self.second["mass"].clone()];
        let axes = &self.place.axes;
        let total_mass = number(&masses[0])? + number(&masses[1])?;
        let arm = origin(&self.second);
        let centres = [
            origin(body).each(|x| 0.0 - x),
            from_fn(|i| self.place.r[i] - (0..3).map(|k| arm[k] * axes[k][i]).sum::<f64>()),
        ];
        let gap = sub(&centres[1], &centres[0]);
        let [own_mass, other_mass] = masses.each_ref().map(written);
        // Of no mass at all there is no centre.
        let reduced = if total_mass > 0.0 { format!("({own_mass})*({other_mass})/{total}") } else { "0".to_string() };
        let centre = |i: usize| format!("-({}) - {}*({other_mass})/{total}", centres[0][i], gap[i]);
        let inertias = [packed(&body["inertia"])?, packed(&self.second["inertia"])?];
        let mut moments = Vec::new();
        for (index, (i, j)) in PLACES.into_iter().enumerate() {
            // axes[k] is the k-th axis of the second body: a vector x of it is sum x_k axes[k].
            let turned = PLACES.each(|(k, l)| {
                let product = axes[k][i] * axes[l][j];
                if k == l { product } else { product + axes[l][i] * axes[k][j] }
            });
            let square = if i == j { dot(&gap, &gap) } else { 0.0 };
            let factors = [&[1.0][..], &turned, &[square - gap[i] * gap[j]]].concat();
            let values = [&[inertias[0][index].clone()][..], &inertias[1], &[json!(reduced)]].concat();
            moments.push(combined(&factors, &json!(values))?);
        }
        body["inertia"] = if self.dimension == 2 { moments[2].clone() } else { json!(moments) };
        body["origin"] = (0..self.dimension).map(centre).collect();
        body["mass"] = json!(total);
        body["initial"] = self.initial.clone();
        self.markers.iter().for_each(|marker| body["markers"][&marker.name] = marker.place.clone());
        Some(json!(format!("{own_mass} + {other_mass}")))
    }
}

/// Places of xx, yy, zz, xy, xz and yz.
pub const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// xx, yy, zz, xy, xz and yz of an inertia; of a number that about all axes.
pub fn packed(inertia: &Value) -> Option<[Value; 6]> {
    Some(match inertia {
        Value::Array(all) => std::array::from_fn(|i| all.get(i).cloned().unwrap_or(json!(0))),
        Value::Null => return None,
        moment => std::array::from_fn(|i| if i < 3 { moment.clone() } else { json!(0) }),
    })
}

/// A placement in the axes of another and from its origin.
fn seen(base: &PlacedMarker, place: &PlacedMarker) -> PlacedMarker {
    let local = |vector: [f64; 3]| base.axes.each(|axis| dot(&axis, &vector));
    PlacedMarker {
        r: local(sub(&place.r, &base.r)),
        axes: place.axes.map(local),
        turn: place.turn - base.turn,
        ..*place
    }
}
