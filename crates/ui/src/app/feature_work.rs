//! Features: their commands and events brought to them, and what they ask of the app.

use super::{App, SideTab, is_sheet};
use crate::command::{Command, Workspace};
use crate::documents::Session;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureId, FeaturePlace, FeatureWishes, FlightFiles,
    FlightWish, OpenedSet, PanelWish,
};
use crate::feature_command::Show;
use crate::host::Host;
use pilotage_jobs::{FlightSource, JobEvent, JobId, MapSource, OpenedFiles};

impl App {
    /// Lends the app to the feature at `index` while it does something.
    fn with_feature(
        &mut self,
        index: usize,
        egui: &egui::Context,
        host: &mut dyn Host,
        work: &mut dyn FnMut(&mut dyn Feature, &mut FeatureContext<'_>),
    ) {
        let (before, rest) = self.views.features.split_at_mut(index);
        let Some((feature, behind)) = rest.split_first_mut() else {
            return;
        };
        let (own, place) = (feature.info().id, feature.info().place);
        let is_shown = match place {
            FeaturePlace::Workspace(own) => self.view.workspace == own,
            FeaturePlace::Window(over) => self.view.workspace == over && feature.takes_window(),
            FeaturePlace::BesideMap => feature.takes_window(),
            FeaturePlace::Dialog => feature.is_open_over(),
            FeaturePlace::Nowhere => false,
            FeaturePlace::Tab
            | FeaturePlace::Sheet
            | FeaturePlace::FirstTab
            | FeaturePlace::PictureTab => {
                self.view.workspace == Workspace::Replay && self.side_tab == SideTab::Feature(own)
            }
        };
        let keeping = &self.keeping;
        let kept = |key: &str| keeping.files(key);
        let mut context = FeatureContext {
            documents: &mut self.documents,
            playback: &mut self.playback,
            selection: &mut self.selection,
            map: &mut self.views.map,
            view: &mut self.view,
            toasts: &mut self.toasts,
            host,
            egui,
            own,
            is_shown,
            kept: &kept,
            beside: [before, behind],
            wishes: FeatureWishes::default(),
        };
        work(feature.as_mut(), &mut context);
        let wishes = context.wishes;
        match wishes.panel {
            Some(PanelWish::Shown) => self.show_feature(own, place),
            Some(PanelWish::Hidden) if is_shown => {
                self.view.workspace = Workspace::Replay;
                self.side_tab = self.views.usual_tab();
            }
            Some(PanelWish::Hidden | PanelWish::Offered) | None => {}
        }
        if wishes.is_run_stale {
            self.run_is_stale(host.now());
        }
        if wishes.is_log_lost {
            let features = self.views.features.iter_mut();
            features.for_each(|feature| feature.on_log_lost());
        }
        self.stored.document_changed |= wishes.is_document_changed;
        if let Some(id) = wishes.presented {
            self.present_landmark(id);
        }
        for command in wishes.commands {
            self.execute(command, egui, host);
        }
        if wishes.panel == Some(PanelWish::Offered) {
            self.offer_feature(own);
        }
        for set in wishes.kept {
            self.keeping.keep_few(&set, &mut self.toasts, host);
        }
        if let Some(map) = wishes.map {
            self.change_map(host, map);
        }
        if let Some(files) = wishes.read {
            self.read_flight(&files, egui, host);
        }
        for files in wishes.opened {
            self.open_files(egui, host, files);
        }
        if let Some(session) = wishes.session {
            self.open_session(&session, egui, host);
        }
        match wishes.flight {
            Some(FlightWish::Nothing) => self.fly_work.stop(host),
            Some(FlightWish::Open(open)) => {
                self.fly_over_mission(egui, host, *open);
            }
            Some(FlightWish::Own(own)) => {
                let (flight, map) = *own;
                self.fly_new(egui, host, flight, map, None);
            }
            Some(FlightWish::Read(read)) => self.fly_read(*read, egui, host),
            None => {}
        }
    }

    /// Shows the panel of a feature wherever the flight is looked at, unless a sheet is open.
    fn offer_feature(&mut self, id: FeatureId) {
        if !self.is_flight_hidden() {
            self.view.workspace = Workspace::Replay;
        }
        if !is_sheet(self.side_tab, &self.views.features) {
            self.side_tab = SideTab::Feature(id);
        }
    }

    /// Flies a flight of files that was read, over a map.
    fn fly_read(
        &mut self,
        (read, map): (FlightFiles, MapSource),
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        let flight = FlightSource::Files(read.key);
        if read.is_open {
            // It may have been edited while it was read.
            let session = Session {
                flight,
                map,
                ..self.documents.session()
            };
            self.fly_open(host, session);
        } else {
            self.fly_new(egui, host, flight, map, read.mission);
        }
    }

    /// Lends the app to one feature after the other.
    fn with_each_feature(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        work: &mut dyn FnMut(&mut dyn Feature, &mut FeatureContext<'_>),
    ) {
        for index in 0..self.views.features.len() {
            self.with_feature(index, egui, host, work);
        }
    }

    /// Has the tools of features leave the map, but for that of the feature that takes it.
    pub(super) fn leave_map(
        &mut self,
        to: Option<FeatureId>,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        self.with_each_feature(egui, host, &mut |feature, context| {
            if Some(context.own) != to {
                feature.leave_map(context);
            }
        });
    }

    /// Lets every feature do what is due.
    pub(super) fn tend_features(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        self.with_each_feature(egui, host, &mut |feature, context| feature.tend(context));
        let features = self.views.features.iter();
        let found = features.flat_map(|it| it.findings(&self.documents));
        if self.documents.take_found(found.collect()) {
            egui.request_repaint();
        }
    }

    /// Tells every feature that the run that was under way is over.
    pub(super) fn tell_of_run_over(
        &mut self,
        is_whole: bool,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        self.with_each_feature(egui, host, &mut |feature, context| {
            feature.on_run_over(is_whole, context);
        });
    }

    fn show_feature(&mut self, id: FeatureId, place: FeaturePlace) {
        if let FeaturePlace::Workspace(own) | FeaturePlace::Window(own) = place {
            self.view.workspace = own;
            return;
        }
        if matches!(
            place,
            FeaturePlace::BesideMap | FeaturePlace::Dialog | FeaturePlace::Nowhere
        ) {
            return;
        }
        self.view.workspace = Workspace::Replay;
        self.view.side_open = Some(true);
        self.dialogs.settings = false;
        self.side_tab = SideTab::Feature(id);
    }

    fn feature(&self, id: FeatureId) -> Option<usize> {
        self.views.features.iter().position(|it| it.info().id == id)
    }

    /// Has a feature carry out its command. One that nobody carries out is a fault of the program, and told.
    pub(super) fn execute_feature(
        &mut self,
        command: &FeatureCommand,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        let mut is_done = false;
        if let Some(index) = self.feature(command.to()) {
            if command.action::<Show>().is_some() {
                let place = self.views.features[index].info().place;
                self.show_feature(command.to(), place);
                self.with_feature(index, egui, host, &mut |feature, context| {
                    feature.on_shown(context);
                });
                return;
            }
            self.with_feature(index, egui, host, &mut |feature, context| {
                is_done = feature.execute(command, context);
            });
        }
        if !is_done {
            self.tell_undone(command.to(), host);
        }
    }

    /// Tells of a command that nobody carries out.
    fn tell_undone(&mut self, of: FeatureId, host: &dyn Host) {
        let text =
            format!("Nobody carries out this command of {of}. This is a fault of the program.");
        self.toasts.trouble(host.now(), "Nothing was done", text);
    }

    /// Brings an event to the feature that started its job; false if there is no such feature, or it does not wait for
    /// that job.
    pub(super) fn feature_event(
        &mut self,
        owner: FeatureId,
        egui: &egui::Context,
        host: &mut dyn Host,
        (id, event): (JobId, JobEvent),
    ) -> bool {
        let Some(index) = self.feature(owner) else {
            return false;
        };
        let mut event = Some(event);
        let mut is_awaited = false;
        self.with_feature(index, egui, host, &mut |feature, context| {
            if let Some(event) = event.take() {
                is_awaited = feature.on_event(id, event, context);
            }
        });
        is_awaited
    }

    /// Stops the work of the first feature that has any, among those that tell how far it is or among all; whether one
    /// had.
    pub(super) fn stop_features(
        &mut self,
        is_told: bool,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) -> bool {
        let mut had_work = false;
        for index in 0..self.views.features.len() {
            let is_meant = !is_told || self.views.features[index].progress().is_some();
            if is_meant && !had_work {
                self.with_feature(index, egui, host, &mut |feature, context| {
                    had_work = feature.stop(context);
                });
            }
        }
        had_work
    }

    /// Tells every feature that another flight is open.
    pub(super) fn tell_features_of_flight(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        self.with_each_feature(egui, host, &mut |feature, context| {
            feature.on_flight_changed(context);
        });
    }

    /// Lets every feature take up what it stored at an earlier visit.
    pub(super) fn start_features(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        self.with_each_feature(egui, host, &mut |feature, context| feature.start(context));
    }

    /// Tells every feature of a command; whether one carried it out in the app's place.
    pub(super) fn is_intercepted(
        &mut self,
        command: &Command,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) -> bool {
        let mut is_done = false;
        self.with_each_feature(egui, host, &mut |feature, context| {
            is_done = is_done || feature.intercept(command, context);
        });
        is_done
    }

    /// Lets every feature take its part of what files turned out to hold.
    pub(super) fn give_opened(
        &mut self,
        file: &str,
        opened: &mut OpenedFiles,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        self.with_each_feature(egui, host, &mut |feature, context| {
            feature.take_opened(file, opened, context);
        });
    }

    /// Has a flight in opened files read, and flown then; whoever opened it sees it.
    pub(super) fn read_flight(
        &mut self,
        files: &FlightFiles,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        if !files.is_open {
            self.show_workspace(Workspace::Replay);
        }
        self.with_each_feature(egui, host, &mut |feature, context| {
            feature.read_flight(files, context);
        });
    }

    /// Tells every feature that another flight is about to be flown.
    pub(super) fn tell_of_other_flight(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        self.with_each_feature(egui, host, &mut |feature, context| {
            feature.on_other_flight(context);
        });
    }

    /// Progress of the computation under way, 0 to 1, and its words.
    pub(super) fn progress(&self) -> Option<(f32, &str)> {
        let mut features = self.views.features.iter();
        let of_features = features.find_map(|it| it.progress());
        let flying = self.fly_work.progress().or(of_features);
        let opening = flying.or_else(|| self.openings.progress());
        opening.or_else(|| self.map_work.progress())
    }

    /// Lets every feature look at what files turned out to hold; whether one took all of it.
    pub(super) fn is_taken_first(
        &mut self,
        set: &OpenedSet,
        opened: &mut OpenedFiles,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) -> bool {
        let mut is_done = false;
        self.with_each_feature(egui, host, &mut |feature, context| {
            is_done = is_done || feature.take_first(set, opened, context);
        });
        is_done
    }

    /// Offers opened files to every feature; whether one takes them as its own.
    pub(super) fn are_taken(
        &mut self,
        set: &OpenedSet,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) -> bool {
        let mut is_done = false;
        self.with_each_feature(egui, host, &mut |feature, context| {
            is_done = is_done || feature.take_files(set, context);
        });
        is_done
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::FeatureInfo;
    use crate::job_owners::{JobOwner, JobOwners};
    use pilotage_jobs::{Job, ReadPlacesOrder};

    /// Takes jobs, of which none begins.
    #[derive(Default)]
    struct IdleHost {
        owners: JobOwners,
        begun: JobId,
        events: Vec<(JobId, JobEvent)>,
    }

    impl Host for IdleHost {
        fn now(&self) -> f64 {
            0.0
        }

        fn begin(&mut self, _job: Job) -> JobId {
            self.begun += 1;
            self.begun
        }

        fn owners(&mut self) -> &mut JobOwners {
            &mut self.owners
        }

        fn cancel(&mut self, _job: JobId) {}

        fn hold(&mut self, _job: JobId, _is_held: bool) {}

        fn events(&mut self) -> Vec<(JobId, JobEvent)> {
            std::mem::take(&mut self.events)
        }

        fn opened(&mut self) -> Vec<Vec<crate::host::OpenedFile>> {
            Vec::new()
        }

        fn ask_for_files(&mut self) {}

        fn save_file(&mut self, _name: &str, _bytes: &[u8]) {}

        fn store(&mut self, _key: &str, _bytes: &[u8]) {}

        fn recall(&self, _key: &str) -> Option<Vec<u8>> {
            None
        }
    }

    static DEAF: FeatureInfo = FeatureInfo {
        id: "deaf",
        tab: "Deaf",
        place: FeaturePlace::Nowhere,
        commands: Vec::new,
    };

    /// Feature that starts a job at a command of the action `()`, and forgets to take what comes of it.
    #[derive(Default)]
    struct Deaf {
        job: Option<JobId>,
    }

    impl Feature for Deaf {
        fn info(&self) -> &'static FeatureInfo {
            &DEAF
        }

        fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
            let is_mine = command.action() == Some(&());
            if is_mine {
                let key = "places".to_owned();
                self.job = Some(context.start(Job::ReadPlaces(ReadPlacesOrder { key })));
            }
            is_mine
        }

        fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
            let job = self.job.take();
            if let Some(job) = job {
                context.wait_no_more(job);
            }
            job.is_some()
        }
    }

    /// Every feature, and one that is none.
    fn owners() -> impl Iterator<Item = FeatureId> {
        let all = crate::features::FeatureTable::all();
        let all: Vec<_> = all.iter().map(|feature| feature.info().id).collect();
        all.into_iter().chain(["nobody"])
    }

    fn told(app: &App) -> Vec<&str> {
        let list = app.toasts.list().iter();
        list.map(|toast| toast.title.as_str()).collect()
    }

    #[test]
    fn an_answer_for_which_its_feature_does_not_wait_is_told() {
        let (egui, mut host) = (egui::Context::default(), IdleHost::default());
        let mut app = App::new(&egui, &host);
        app.views.features.push(Box::new(Deaf::default()));
        let begin = || Command::Feature(FeatureCommand::new("deaf", ()));
        app.execute(begin(), &egui, &mut host);
        host.events = vec![(host.begun, JobEvent::Places(Vec::new()))];
        app.receive(&egui, &mut host);
        assert_eq!(told(&app), ["An answer was not used"]);

        // Unless the feature said that it would.
        let mut app = App::new(&egui, &host);
        app.views.features.push(Box::new(Deaf::default()));
        app.execute(begin(), &egui, &mut host);
        assert!(app.stop_features(false, &egui, &mut host));
        host.events = vec![
            (host.begun, JobEvent::Places(Vec::new())),
            (host.begun, JobEvent::Finished),
        ];
        app.receive(&egui, &mut host);
        assert!(told(&app).is_empty());
    }

    #[test]
    fn an_answer_of_another_job_is_told_by_every_feature() {
        let egui = egui::Context::default();
        for owner in owners() {
            let mut host = IdleHost::default();
            let mut app = App::new(&egui, &host);
            host.owners.own(99, JobOwner::Feature(owner));
            host.events = vec![(99, JobEvent::Places(Vec::new()))];
            app.receive(&egui, &mut host);
            assert_eq!(told(&app), ["An answer was not used"], "{owner}");
        }
    }

    #[test]
    fn a_command_that_nobody_carries_out_is_told() {
        let (egui, mut host) = (egui::Context::default(), IdleHost::default());
        for to in owners() {
            let mut app = App::new(&egui, &host);
            app.execute(
                Command::Feature(FeatureCommand::new(to, 1_u8)),
                &egui,
                &mut host,
            );
            assert_eq!(told(&app), ["Nothing was done"], "{to}");
        }
    }
}
