//! `holonom plot SCENE`

use super::common::{Common, Output, fail, number, positive, set_by};
use super::interrupt;
use crate::analysis::Recorder;
use crate::error::{Error, Failure, Result, Warning, clock, significant};
use crate::linearize::State;
use crate::prepared::{Model, Overrides};
use crate::report::mechanism::{
    DrawnMotion, Look, Trace, View, animation, find_trace, mechanism_figure, output_traces, stroboscope_figure, up,
};
use crate::report::{Ending, FinishedRun, Folder, Format, Origin, Shown, outputs_figure};
use crate::simulate::Span;
use crate::trajectory::Trajectory;
use crate::view::{ShownMotion, glb};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom plot models/four_bar_spring.json --stroboscope --until 0.5
  holonom plot models/pendulum.json --until 2 --animate svg --view xy")]
pub struct Args {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    output: Output,
    /// The mechanism at several times in one figure, earlier ones paler
    #[arg(long)]
    stroboscope: bool,
    /// When, s: times of the stroboscope, or the time of a plain figure (default: the start)
    #[arg(long, value_name = "T[,T...]", value_parser = number, value_delimiter = ',', allow_negative_numbers = true,
          conflicts_with = "frames")]
    at: Vec<f64>,
    /// Number of times of the stroboscope, evenly over the run
    #[arg(long, value_name = "N", default_value_t = 6, requires = "stroboscope",
          value_parser = clap::value_parser!(u16).range(2..=100))]
    frames: u16,
    /// The mechanism in motion
    #[arg(long, value_enum, value_name = "FORMAT")]
    animate: Option<AnimationFormat>,
    /// The motion as motion.glb, a file of glTF for viewers, slides and Blender
    #[arg(long)]
    gltf: bool,
    /// Frames a second
    #[arg(long, default_value_t = 25.0, requires = "animate", value_parser = rate)]
    fps: f64,
    /// Seconds of the scene in a second of the animation (default: 1 where that takes 2 to 20 s, else what takes 4 to
    /// 10 s)
    #[arg(long, value_name = "FACTOR", requires = "animate", value_parser = positive, allow_negative_numbers = true)]
    speed: Option<f64>,
    /// Outputs over time, or coordinates where the scene has none
    #[arg(long)]
    outputs: bool,
    /// One panel an output (default: one for those of a unit whose ranges are alike)
    #[arg(long, requires = "outputs")]
    separate: bool,
    /// Draw a finished run in the place of a new one: its folder, such as out/NAME, whose parameters it takes
    #[arg(long, value_name = "DIR", conflicts_with_all = ["set", "equilibrium", "method", "formulation", "integrator",
          "projection", "rtol", "atol", "step", "adaptive", "until", "output_step"])]
    from: Option<PathBuf>,
    /// Markers whose paths are drawn, or none (default: those whose positions are outputs)
    #[arg(long, value_name = "BODY.MARKER[,...]", value_delimiter = ',')]
    trace: Vec<String>,
    /// From where a spatial scene is seen: iso, xy, xz, yz, front, side, top or azimuth=DEG,elevation=DEG
    /// (default: iso)
    #[arg(long)]
    view: Option<String>,
    /// Write the names of the bodies beside them
    #[arg(long)]
    labels: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum AnimationFormat {
    Gif,
    Svg,
}

/// Reads frames per second; viewers show a GIF no faster than 50.
fn rate(text: &str) -> Result<f64, String> {
    positive(text)
        .and_then(|fps| if fps <= 50.0 { Ok(fps) } else { Err("at most 50 frames a second can be shown".to_string()) })
}

/// Least and largest number of rows of the trajectory.
const ROWS: (f64, f64) = (600.0, 20_000.0);
/// Longer animations are probably a mistake.
const MOST_FRAMES: f64 = 1000.0;

#[derive(Serialize)]
struct Drawn {
    scene: String,
    status: &'static str,
    failure: Option<Failure>,
    times: Vec<f64>,
    animation: Option<Film>,
    #[serde(skip)]
    has_gltf: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
}

#[derive(Serialize)]
struct Film {
    frames: usize,
    fps: f64,
    /// Seconds of the scene in a second of the animation.
    speed: f64,
    start: f64,
    end: f64,
}

pub fn run(args: Args) -> Result<ExitCode> {
    let read = |path: &Path| FinishedRun::read(path, !args.is_in_motion());
    let finished = args.from.as_deref().map(read).transpose()?;
    let prepared = args.load(finished.as_ref())?;
    let look = args.look(&prepared)?;
    let failed = finished.as_ref().and_then(|run| run.failure.clone());
    let ending = finished.as_ref().map_or(Ending::Completed, |run| run.ending);
    let finished = finished.map(|run| run.trajectory(prepared.system())).transpose()?;
    let span = args.span(&prepared, finished.as_ref())?;
    args.check(&prepared, span)?;
    let mut folder = args.output.folder(&prepared.name)?;
    let (mut trajectory, ending, failure) = match (finished, span) {
        (Some(trajectory), _) => (trajectory, ending, None),
        (None, Some(span)) => args.simulate(&prepared, span, &folder)?,
        (None, None) => (Trajectory::new(prepared.system()), ending, None),
    };
    let shown = Shown::of_trajectory(ending, &trajectory);
    trajectory.rows.truncate(shown.rows);
    let mut drawn = Drawn {
        scene: prepared.name.clone(),
        status: if failure.is_some() || failed.is_some() { "failed" } else { "completed" },
        failure: failure.clone().or(failed),
        times: Vec::new(),
        animation: None,
        has_gltf: args.gltf,
        files: Vec::new(),
    };
    let motion = DrawnMotion::new(&prepared, &trajectory).titled(shown.title(&prepared.name));
    args.common.talk.warn(&motion.sparse().filter(|_| args.from.is_some() && args.is_in_motion()));
    args.draw(&motion, &shown, &look, &mut folder, &mut drawn)?;
    drawn.files = folder.paths();
    args.common.talk.conclude(folder, &drawn, || drawn.text())?;
    failure.map_or(Ok(ExitCode::SUCCESS), |failure| fail(Error::from(failure)))
}

impl Args {
    /// Returns the scene, with the parameters of the finished run if there is one.
    fn load(&self, finished: Option<&FinishedRun>) -> Result<Model> {
        let Some(run) = finished else { return self.common.load() };
        let overrides = Overrides { set: run.parameters.clone(), ..Overrides::default() };
        let prepared = self.common.talk.load(&self.common.scene.path, &overrides);
        let prepared = prepared.map_err(|error| set_by(error, "--from"))?;
        self.common.talk.warn(&run.failure.as_ref().map(|failure| {
            Warning::new(format!("this run stopped at t = {} s: {}", clock(failure.t), failure.reason), &failure.hint)
        }));
        Ok(prepared)
    }

    /// True if the mechanism is drawn at other times than its start.
    fn is_in_motion(&self) -> bool {
        self.stroboscope || self.animate.is_some() || !self.at.is_empty() || self.gltf
    }

    /// Returns the time span of the motion. The start alone needs no run, and no end time.
    fn span(&self, prepared: &Model, finished: Option<&Trajectory>) -> Result<Option<Span>> {
        match finished {
            _ if !self.is_in_motion() && !self.outputs => Ok(None),
            None => self.common.span(prepared).map(Some),
            Some(trajectory) if self.is_in_motion() && trajectory.names.q.is_empty() => {
                Err(Error::input("the coordinates were left out of this run, so that only --outputs can be drawn")
                    .under("--from")
                    .hint("simulate without --outputs-only, or leave out --from"))
            }
            Some(trajectory) => {
                let (start, end) = DrawnMotion::new(prepared, trajectory).reach();
                Ok(Some(Span { start, end, output_step: prepared.span().map_or(end - start, |span| span.output_step) }))
            }
        }
    }

    fn look(&self, prepared: &Model) -> Result<Look> {
        let is_planar = prepared.mechanism.dimension() == 2;
        let plain = Look::plain(&prepared.mechanism);
        let view = match &self.view {
            None => plain.view,
            Some(name) => {
                let view = View::parse(name, up(&prepared.mechanism)).map_err(|error| error.under("--view"))?;
                if is_planar && view != View::planar() {
                    let error = Error::input(format!("the scene is planar and cannot be seen from `{name}`"));
                    return Err(error.under("--view").hint("leave it out, or give xy"));
                }
                view
            }
        };
        let traces = match self.trace.as_slice() {
            [] => output_traces(&prepared.mechanism),
            [none] if none == "none" => Vec::new(),
            names => {
                let find = |name: &String| find_trace(&prepared.mechanism, name.trim());
                names.iter().map(find).collect::<Result<Vec<Trace>>>().map_err(|error| error.under("--trace"))?
            }
        };
        Ok(Look { view, labels: self.labels, traces })
    }

    /// Refuses what cannot be drawn, before anything is computed.
    fn check(&self, prepared: &Model, span: Option<Span>) -> Result<()> {
        if self.output.figures == Format::None
            && (self.stroboscope || self.outputs || self.animate.is_none() && !self.gltf)
        {
            return Err(Error::input("there is nothing to draw").under("--figures").hint("choose svg or png"));
        }
        if self.at.len() > 1 && !self.stroboscope {
            let error = Error::input(format!("{} times for one figure", self.at.len())).under("--at");
            return Err(error.hint("give one, or --stroboscope for several in one figure"));
        }
        let Some(span) = span else { return Ok(()) };
        if let Some(t) = self.at.iter().find(|t| !(span.start..=span.end).contains(*t)) {
            let range = format!("the run goes from {} s to {} s", span.start, span.end);
            return Err(Error::input(format!("{t} s is outside the run")).under("--at").hint(range));
        }
        if self.animate.is_some() {
            self.film(span.start, span.end).map_err(|error| error.element(&prepared.name))?;
        }
        Ok(())
    }

    /// Runs the scene, with rows close enough to interpolate the states between them.
    fn simulate(&self, prepared: &Model, span: Span, folder: &Folder) -> Result<(Trajectory, Ending, Option<Failure>)> {
        let length = span.end - span.start;
        let wanted = (length / span.output_step).clamp(ROWS.0, ROWS.1);
        // Evenly chosen times are times of rows.
        let gaps = f64::from(self.frames) - 1.0;
        let output_step = length / ((wanted / gaps).ceil() * gaps);
        let mut recorder = Recorder::new(prepared.system())
            .with_progress(self.common.talk.progress_between(span.start, span.end, &prepared.name))
            .with_stop(|| interrupt::stop(folder));
        let (outcome, _) = prepared.simulate(&prepared.method, Span { output_step, ..span }, &mut recorder)?;
        let record = recorder.finish();
        let ending = Ending::of(outcome.failure.as_ref(), &record.drift, record.energy.as_ref());
        Ok((record.trajectory, ending, outcome.failure))
    }

    fn draw(
        &self,
        motion: &DrawnMotion,
        shown: &Shown,
        look: &Look,
        folder: &mut Folder,
        drawn: &mut Drawn,
    ) -> Result<()> {
        let prepared = motion.prepared;
        if self.stroboscope {
            drawn.times = self.times(motion);
            let figure = stroboscope_figure(motion, look, &drawn.times);
            folder.figure("stroboscope", Some(figure))?;
            self.seal(folder, "stroboscope", prepared, drawn)?;
        } else if self.animate.is_none() && !self.outputs && !self.gltf || !self.at.is_empty() {
            let t = self.at.first().map_or(prepared.start_time(), |t| t.min(motion.reach().1));
            let state = if self.at.is_empty() { State::start(prepared) } else { motion.state(t) };
            drawn.times = vec![t];
            folder.figure("mechanism", Some(mechanism_figure(prepared, look, &state)))?;
            self.seal(folder, "mechanism", prepared, drawn)?;
        }
        if self.outputs {
            let figure = outputs_figure(&prepared.name, motion.trajectory(), None, shown, self.separate);
            folder.figure("plot-outputs", figure)?;
            self.seal(folder, "plot-outputs", prepared, drawn)?;
        }
        if self.gltf {
            let run = ShownMotion::new(prepared, motion.trajectory());
            folder.write("motion.glb", &glb(&run, 1000))?;
            self.seal(folder, "motion", prepared, drawn)?;
        }
        match self.animate {
            Some(format) => self.animation(format, motion, look, folder, drawn),
            None => Ok(()),
        }
    }

    /// Returns the chosen times up to the end of the run; else evenly spaced ones.
    fn times(&self, motion: &DrawnMotion) -> Vec<f64> {
        let (start, end) = motion.reach();
        if !self.at.is_empty() {
            let mut times: Vec<f64> = self.at.iter().copied().filter(|t| *t <= end).collect();
            times.sort_by(f64::total_cmp);
            times.dedup();
            return if times.is_empty() { vec![end] } else { times };
        }
        let last = f64::from(self.frames) - 1.0;
        let part = |k: u16| f64::from(k) / last;
        (0..self.frames).map(|k| if f64::from(k) == last { end } else { start + part(k) * (end - start) }).collect()
    }

    fn film(&self, start: f64, end: f64) -> Result<Film> {
        let speed = self.speed.unwrap_or_else(|| suitable_speed(end - start));
        let frames = ((end - start) / speed * self.fps).round().max(1.0) + 1.0;
        if frames > MOST_FRAMES {
            let least = (end - start) * self.fps / (MOST_FRAMES - 1.0);
            let error = Error::input(format!("the animation would have {frames} frames, more than {MOST_FRAMES}"));
            return Err(error.under("--animate").hint(format!(
                "give --speed {} or more, fewer frames a second with --fps, or an earlier end with --until",
                significant(1.05 * least, 2)
            )));
        }
        Ok(Film { frames: frames as usize, fps: self.fps, speed, start, end })
    }

    fn animation(
        &self,
        format: AnimationFormat,
        motion: &DrawnMotion,
        look: &Look,
        folder: &mut Folder,
        drawn: &mut Drawn,
    ) -> Result<()> {
        let (start, end) = motion.reach();
        let film = self.film(start, end)?;
        let last = (film.frames - 1) as f64;
        let times = (0..film.frames).map(|k| start + (end - start) * k as f64 / last).collect();
        let animation = animation(motion, look, times, film.fps, speed_text(film.speed));
        match format {
            AnimationFormat::Svg => folder.write("animation.svg", animation.to_svg().as_bytes())?,
            AnimationFormat::Gif => {
                let bar = self.common.talk.progress(film.frames as u64, "frames");
                let bytes = animation.to_gif(|done| bar.set_position(done as u64)).map_err(Error::input)?;
                folder.write("animation.gif", &bytes)?;
            }
        }
        drawn.animation = Some(film);
        self.seal(folder, "animation", motion.prepared, drawn)
    }

    /// Writes what it takes to draw the figure again.
    fn seal(&self, folder: &mut Folder, name: &str, prepared: &Model, drawn: &Drawn) -> Result<()> {
        let origin = self.common.talk.origin(prepared);
        let simulation = origin.simulation.filter(|_| self.from.is_none());
        folder.seal(&format!("{name}.json"), Origin { simulation, ..origin }, drawn).map(drop)
    }
}

/// Returns real time where the animation takes 2 to 20 s; else 1, 2 or 5 times a power of ten that makes it 4 to 10 s.
fn suitable_speed(length: f64) -> f64 {
    if (2.0..=20.0).contains(&length) {
        return 1.0;
    }
    let exact = length / 10.0;
    let power = 10f64.powf(exact.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power).into_iter().find(|speed| *speed >= 0.999 * exact).unwrap_or(exact)
}

fn speed_text(speed: f64) -> String {
    match speed {
        1.0 => String::new(),
        slow if slow < 1.0 => format!("{} times slower", significant(1.0 / slow, 3)),
        fast => format!("{} times faster", significant(fast, 3)),
    }
}

impl Drawn {
    fn text(&self) -> String {
        let times: Vec<String> = self.times.iter().map(|t| significant(*t, 4)).collect();
        let mut lines = Vec::new();
        if !times.is_empty() {
            lines.push(format!("{} at t = {} s", self.scene, times.join(", ")));
        }
        if let Some(film) = &self.animation {
            let speed = speed_text(film.speed);
            let pace = if speed.is_empty() { "in real time".to_string() } else { speed };
            let span = format!("from {} to {} s", significant(film.start, 4), significant(film.end, 4));
            lines.push(format!("{} {span}: {} frames, {} a second, {pace}", self.scene, film.frames, film.fps));
        }
        if self.has_gltf {
            lines.push(format!("{}: the motion as glTF", self.scene));
        }
        if lines.is_empty() {
            lines.push(format!("{}: outputs over time", self.scene));
        }
        lines.join("\n") + "\n"
    }
}
