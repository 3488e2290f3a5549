//! The files of a Git revision, for checks that are limited to what has changed since then. (book: reference/commands, `check`)

use std::collections::BTreeMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, is_drawing, join, with_forward_slashes};

use crate::check::EarlierFiles;
use crate::config::clean;
use crate::files::{self, FILE_NAME, MAX_LINKS};
use crate::git::{self, EntryKind, Repository};
use crate::workspace::Workspace;
use crate::{Input, Inputs};

/// The file names and blob ids in a revision. File names are relative to the root of the working tree.
#[derive(Debug)]
pub struct RevisionFiles<'a> {
    workspace: &'a Workspace,
    repository: Repository<'a>,
    /// The baseline of the run, which decides what is reported.
    baseline: Utf8PathBuf,
    files: BTreeMap<Utf8PathBuf, String>,
    links: BTreeMap<Utf8PathBuf, String>,
    /// File names of the drawings, by directory.
    drawings: BTreeMap<Utf8PathBuf, Vec<String>>,
}

impl<'a> RevisionFiles<'a> {
    /// Reads a revision from the repository of the inputs, for a run with this baseline; `None` is the default one.
    ///
    /// # Errors
    /// Git's message if it cannot read the revision.
    pub fn new(
        workspace: &'a Workspace,
        inputs: &Inputs,
        baseline: Option<&Utf8Path>,
        revision: &str,
    ) -> Result<Self, String> {
        let revision = git::revision(workspace, revision)?;
        let repository = Repository::of(workspace, &repository_place(workspace, inputs))?;
        let entries = match repository.tree(revision) {
            Ok(tree) => repository.entries(&tree)?,
            // Before the first commit, everything is new.
            Err(_) if repository.is_unborn(revision) => Vec::new(),
            Err(reason) => return Err(repository.shallow_clone_advice(revision).unwrap_or(reason)),
        };
        let (files, links, drawings) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        let baseline = workspace.baseline_file(baseline);
        let mut revision_files = Self { workspace, repository, baseline, files, links, drawings };
        for entry in entries.into_iter().filter(git::Entry::is_plain) {
            revision_files.add(entry.kind, entry.name.into(), entry.id);
        }
        Ok(revision_files)
    }

    fn add(&mut self, kind: EntryKind, file: Utf8PathBuf, id: String) {
        if let (Some(directory), Some(name)) = (file.parent(), file.file_name())
            && is_drawing(&file)
        {
            self.drawings.entry(directory.to_owned()).or_default().push(name.to_owned());
        }
        match kind {
            // Git for Windows checks out symbolic links as plain files.
            EntryKind::Link if cfg!(unix) => self.links.insert(file, id),
            EntryKind::File | EntryKind::Link => self.files.insert(file, id),
            // The contents of a submodule are unknown: all its files are treated as new.
            EntryKind::Submodule => None,
        };
    }

    /// Returns the real path of a file, with all symbolic links resolved.
    fn real(&self, file: &Utf8Path) -> Utf8PathBuf {
        self.workspace.system.canonical(&clean(&self.workspace.working_directory.join(file)))
    }

    /// Returns a real path relative to the root; `None` if it is outside.
    fn below_root(&self, real: &Utf8Path) -> Option<Utf8PathBuf> {
        Some(with_forward_slashes(real.strip_prefix(&self.repository.root).ok()?.to_owned()))
    }

    /// Returns the real path of a file and its blob id in the revision; `None` if the file must be treated as changed.
    fn file_in_revision(&self, file: &Utf8Path) -> Option<(Utf8PathBuf, &str)> {
        let real = self.real(file);
        let id = self.files.get(&self.below_root(&real)?)?;
        // Git would hang on special files and very large ones, and expects one file name per line.
        let largest = self.workspace.settings.limits.file_size.value;
        let is_regular = self.workspace.system.read_head(&real, 1).is_ok();
        let is_comparable = is_regular
            && !real.as_str().contains('\n')
            && files::size(&real).is_some_and(|size| size <= largest);
        (is_comparable && self.has_old_links(file, &real)).then_some((real, id))
    }

    /// Whether all symbolic links of the working tree on the way to a file existed in the revision. Their targets are compared in `changed_link`.
    fn has_old_links(&self, file: &Utf8Path, real: &Utf8Path) -> bool {
        let spelt = clean(&self.workspace.working_directory.join(file));
        if spelt == real {
            return true;
        }
        let mut open = vec![spelt];
        for _ in 0..MAX_LINKS {
            let Some(path) = open.pop() else { return true };
            for link in path.ancestors() {
                let Ok(target) = link.read_link_utf8() else { continue };
                let (Some(directory), Some(name)) = (link.parent(), link.file_name()) else { return false };
                let directory = self.workspace.system.canonical(directory);
                let in_tree = self.below_root(&join(&directory, name));
                if in_tree.is_some_and(|link| !self.links.contains_key(&link)) {
                    return false;
                }
                open.push(directory.join(target));
            }
        }
        false
    }

    fn changed_link(&self) -> Option<Utf8PathBuf> {
        let ids: Vec<&str> = self.links.values().map(String::as_str).collect();
        // A target that cannot be read is treated as changed.
        let targets = self.repository.targets(&ids).unwrap_or_else(|_| vec![None; ids.len()]);
        let mut links = self.links.keys().map(|link| self.repository.root.join(link)).zip(targets);
        let is_same = |link: &Utf8Path, target: Option<&str>| {
            target.is_some() && link.read_link_utf8().ok().as_deref().map(Utf8Path::as_str) == target
        };
        links.find(|(link, target)| !is_same(link, target.as_deref())).map(|(link, _)| link)
    }

    /// Returns the files that determine what is checked and reported, such as configurations: those of the revision, and the current ones.
    fn rules(&self, directories: &[Utf8PathBuf]) -> Vec<Utf8PathBuf> {
        let baseline = self.below_root(&self.real(&self.baseline));
        let is_rule = |file: &&Utf8PathBuf| {
            matches!(file.file_name(), Some(FILE_NAME | ".gitignore" | ".ignore"))
                || Some(*file) == baseline.as_ref()
                || file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("cbpp"))
        };
        let old = self.files.keys().filter(is_rule).map(|file| self.repository.root.join(file));
        let ignoring = directories.iter().flat_map(|directory| {
            [".gitignore", ".ignore"].map(|name| self.workspace.working_directory.join(directory).join(name))
        });
        let settings = &self.workspace.settings;
        let post = settings.directory().map(|directory| directory.join(&*settings.general.post.value.name));
        let now = ignoring.chain(settings.file.clone()).chain(post).chain([self.baseline.clone()]);
        old.chain(now.filter(|file| self.workspace.system.kind(file) == FileKind::File)).collect()
    }
}

impl EarlierFiles for RevisionFiles<'_> {
    fn changed(&self, files: &[Utf8PathBuf]) -> Vec<bool> {
        let committed: Vec<_> = files.iter().map(|file| self.file_in_revision(file)).collect();
        let comparable: Vec<&Utf8Path> = committed.iter().flatten().map(|(real, _)| &**real).collect();
        let mut ids = self.repository.ids(&comparable).into_iter();
        let is_same = |(_, id): &(Utf8PathBuf, &str)| ids.next().is_some_and(|now| now == *id);
        let same: Vec<bool> = committed.iter().flatten().map(is_same).collect();
        let mut same = same.into_iter();
        committed.iter().map(|committed| committed.is_none() || same.next() != Some(true)).collect()
    }

    fn drawings(&self, directory: &Utf8Path) -> &[String] {
        let directory = self.below_root(&self.real(directory));
        directory.and_then(|directory| self.drawings.get(&directory)).map_or(&[], Vec::as_slice)
    }

    fn changed_common_file(&self, directories: &[Utf8PathBuf]) -> Option<Utf8PathBuf> {
        let rules = self.rules(directories);
        let mut changed = self.changed(&rules).into_iter().zip(rules);
        changed.find_map(|(is_changed, rule)| is_changed.then_some(rule)).or_else(|| self.changed_link())
    }
}

/// Returns the file or directory that determines the repository: the root of an untrusted tree; otherwise the first file or directory among the
/// arguments, the configuration's directory, or the working directory.
fn repository_place(workspace: &Workspace, inputs: &Inputs) -> Utf8PathBuf {
    if let Some(confined) = &workspace.settings.confined {
        return confined.root().to_owned();
    }
    let is_directory = |name: &str| workspace.system.kind(Utf8Path::new(name)) == FileKind::Directory;
    let argument_directory = inputs.iter().find_map(|input| match input {
        Input::Place(place) => Some(place),
        Input::Name(name) => is_directory(name).then_some(Utf8Path::new(name)),
    });
    argument_directory.or(workspace.settings.directory()).unwrap_or(Utf8Path::new("")).to_owned()
}
