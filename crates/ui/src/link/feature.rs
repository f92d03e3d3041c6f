//! Links as a feature: copied, and followed where the page was opened with one.

use pilotage_jobs::FlightSource;

use super::{BEFORE_LINK_KEY, LINK_KEY, Link};
use crate::command::Command;
use crate::documents::{Documents, SESSION_KEY, Session};
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureId, FeatureInfo, FeaturePlace,
};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry};

/// Identity of the feature.
const ID: FeatureId = "link";

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Link",
    place: FeaturePlace::Nowhere,
    commands,
};

/// Something about links.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LinkCommand {
    /// Copy a link to the view of the built-in flight.
    Copy,
    /// Go back to what was open before a link was followed.
    OpenBefore,
}

fn commands() -> Vec<CommandEntry> {
    let all = [
        ("Copy a link to this view", LinkCommand::Copy),
        (
            "Open what was open before the link",
            LinkCommand::OpenBefore,
        ),
    ];
    let row = |(label, command)| {
        let is_rare = command == LinkCommand::OpenBefore;
        let command = Command::Feature(FeatureCommand::new(ID, command));
        let row = entry(CommandGroup::Document, label, vec![], command).also("share url");
        if is_rare {
            row
        } else {
            row.under(BarMenu::Save)
        }
    };
    all.into_iter().map(row).collect()
}

/// Link that the page was opened with.
#[derive(Debug, Default)]
pub struct LinkFeature {
    /// View that is shown once its flight is there.
    followed: Option<Link>,
    /// Sessions that were open before it, or before those of earlier visits, in the order in which they are brought back.
    before: Vec<Session>,
    /// Words about the link that is being copied.
    copying: Option<&'static str>,
}

/// Sessions one behind the other, in lines: none of them has a line break.
fn encode_all(sessions: &[Session]) -> Vec<u8> {
    let all: Vec<_> = sessions.iter().map(Session::encode).collect();
    all.join(&b'\n')
}

fn decode_all(bytes: &[u8]) -> Vec<Session> {
    let lines = bytes.split(|byte| *byte == b'\n');
    lines.filter_map(Session::decode).collect()
}

impl LinkFeature {
    /// Opens the flight of a link; what was open before is kept aside if there is work in it.
    fn follow(&mut self, link: Link, context: &mut FeatureContext<'_>) {
        if let Some(own) = work(context.documents) {
            self.before.retain(|kept| *kept != own);
            self.before.insert(0, own);
            context
                .host
                .store(BEFORE_LINK_KEY, &encode_all(&self.before));
            let text = "It is kept aside: “Open what was open before the link”, among all commands \
                        (Ctrl+K), brings it back.";
            context.note("A link was opened instead of your own work", text);
        }
        *context.documents = Documents::new(&Session {
            flight: FlightSource::Simulated(link.simulation.clone()),
            ..Session::demo()
        });
        context.view.workspace = link.workspace;
        self.followed = Some(link);
    }

    /// Goes back to what was open before a link was followed; work done since is kept aside behind what else is.
    fn open_before(&mut self, context: &mut FeatureContext<'_>) {
        if self.before.is_empty() {
            let text = "No link was opened over work of yours.";
            context.note("Nothing was kept aside", text);
            return;
        }
        let session = self.before.remove(0);
        if let Some(own) = work(context.documents) {
            self.before.retain(|kept| *kept != own);
            self.before.push(own);
            let text = match self.before.len() {
                1 => "It is kept aside in turn: the same command brings it back.".to_owned(),
                count => format!(
                    "It is kept aside in turn: the same command goes on through all {count} that are."
                ),
            };
            context.note("Your own work is open in the place of later work", text);
        }
        if self.before.is_empty() {
            context.host.forget(BEFORE_LINK_KEY);
        } else {
            context
                .host
                .store(BEFORE_LINK_KEY, &encode_all(&self.before));
        }
        context.host.store(SESSION_KEY, &session.encode());
        context.open_session(session);
    }
}

/// Session of the open documents, if there is work in it.
fn work(documents: &Documents) -> Option<Session> {
    let own = documents.session();
    let is_work = own.mission.is_some() || matches!(own.flight, FlightSource::Files(_));
    is_work.then_some(own)
}

/// Copies a link to what is shown; words about it, for when that is done.
fn copy(context: &mut FeatureContext<'_>) -> Option<&'static str> {
    let FlightSource::Simulated(simulation) = &context.documents.flight.source else {
        let text = "A link carries the view and the built-in flights only. Save the mission as a \
                    file to pass on what you have opened.";
        context.note("Opened files do not fit into a link", text);
        return None;
    };
    let camera = &context.map.camera;
    let link = Link {
        simulation: simulation.clone(),
        workspace: context.view.workspace,
        center: camera.center,
        scale: camera.metres_per_point,
        up: camera.up,
        time: context.playback.time,
    };
    context.host.copy_link(&link.encode());
    Some(if context.documents.mission.is_edited {
        "It carries the view and the built-in flight, not your edits: save the mission as a file \
         to pass them on."
    } else {
        "Whoever opens it sees this view of the built-in flight."
    })
}

impl Feature for LinkFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        match command.action() {
            Some(LinkCommand::Copy) => self.copying = copy(context),
            Some(LinkCommand::OpenBefore) => self.open_before(context),
            None => return false,
        }
        true
    }

    /// Follows the link that the page was opened with.
    fn start(&mut self, context: &mut FeatureContext<'_>) {
        // Its files stay until it is opened again.
        let kept = context.host.recall(BEFORE_LINK_KEY);
        self.before = kept.map(|bytes| decode_all(&bytes)).unwrap_or_default();
        let fragment = context.host.recall(LINK_KEY);
        let fragment = fragment.and_then(|bytes| String::from_utf8(bytes).ok());
        if let Some(link) = fragment.and_then(|text| Link::decode(&text)) {
            self.follow(link, context);
        }
    }

    /// Looks at the flight as the link says, once the flight is there.
    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        if context.documents.run.navigated.is_none() {
            return;
        }
        let Some(link) = self.followed.take() else {
            return;
        };
        let map = &mut *context.map;
        map.stay();
        map.camera.center = link.center;
        map.camera.metres_per_point = link.scale;
        map.camera.up = link.up;
        context.playback.playing = false;
        let span = context.documents.span();
        context.playback.seek(link.time, span);
    }

    /// Says that a link was copied once it is; where it could not be, the page has shown it.
    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        let copied = self.copying.and_then(|_| context.host.link_copied());
        let Some(is_copied) = copied else { return };
        if let Some(text) = self.copying.take().filter(|_| is_copied) {
            context.note("Link copied", text);
        }
    }

    fn used_files(&self) -> Vec<&str> {
        let before = self.before.iter();
        let keys = before.flat_map(|it| [it.flight.key(), it.map.key()]);
        keys.flatten().collect()
    }
}
