// What the page says itself, in the robot's language.

const EN = {
  sensor: "Sees through", memory: "Remembers in", words: "Words known",
  opening: "Connecting …", open: "Connected", lost: "Lost: trying again …",
  picture: "What the robot sees", things: "Things in view", talk: "The lesson", seen: "The table",
  say: "Say something to the robot", placeholder: "This is a cup.", send: "Say",
  answers: "Answers", tools: "What you can do",
  look: "Look", region: "Mark a region", restart: "New dialogue",
  hint: "Click a thing: “this”; a second: “that”. Drag: a region. Keys 1–9, R, /",
  box: "A region: arrow keys move it, with Shift they resize it. Enter: “this” is that. Escape: never mind.",
  table: "Change what is on the table", show: "Show only the {thing}", add: "Put the {thing} on the table",
  catalogue: "What can be put there", plan: "The table from above",
  placed: "{thing}: {right} cm right, {away} cm away, turned {turn}°",
  planHint: "Drag things, or move them by the arrow keys (Shift: further). R turns, Delete removes.",
  wind: "Wind the recording", moment: "{at} of {length} s",
  empty: "Nothing is in view.",
  thing: "#{number}, {word}", this: "this", that: "that",
  percent: "{percent} %", nameless: "no word for it yet",
  took: "{seconds} s", tookMs: "{ms} ms", undo: "Undo", why: "Why?",
  learned: "learned: {word}", unlearned: "taken back: {word}",
  rules: "What it did", you: "You", robot: "The robot",
  again: "The robot was started anew. All that it had confirmed is kept.",
  unconfirmed: "It had not confirmed your last sentence: it is back in the field, to be said again.",
  anew: "A new dialogue; what was learned stays.",
  full: "Too many browsers look at this page.",
  lab: "Look inside", inside: "Look inside this turn", timeline: "Turn", changed: "changed",
  turn: "Turn {number}: {heard}", noTurn: "No turn has been taken yet", looked: "it looked",
  now: "Back to now", replayed: "As it was: {turn}", on: "on", when: "when", gone: "That turn is not kept any more.",
  unfired: "Rules that did not fire, and why", insteadOf: "Fired: {rules}. Not fired:", others: "{count} more wait for other events.",
  foundNothing: "the condition holds, but what the rule is for is not the case", cameLater: "it would have fired, but another came first",
  rulesCount: "({count})",
  save: "Save as a file", saveTurn: "This turn", saveAll: "The dialogue", dlg: "story (.dlg)", log: "log", tex: "state (LaTeX)",
  derivation: "Derivation", shared: "Shared", view: "In view", private: "Private", empties: "Empty: {names}",
  begin: "Click on a thing and say what it is: “This is a cup.” Or ask: “What is this?” “Help.” says what else.",
};

const SV = {
  sensor: "Ser genom", memory: "Minns i", words: "Kända ord",
  opening: "Ansluter …", open: "Ansluten", lost: "Avbrott: försöker igen …",
  picture: "Vad roboten ser", things: "Saker i bild", talk: "Lektionen", seen: "Bordet",
  say: "Säg något till roboten", placeholder: "Det här är en kopp.", send: "Säg",
  answers: "Svar", tools: "Vad du kan göra",
  look: "Titta", region: "Märk ut", restart: "Ny dialog",
  hint: "Klicka på en sak: ”det här”; en till: ”det där”. Dra: ett område. Tangenter 1–9, R, /",
  box: "Ett område: piltangenterna flyttar det, med skift ändras storleken. Enter: ”det här” är det. Escape: strunta i det.",
  table: "Ändra vad som finns på bordet", show: "Visa bara: {thing}", add: "Lägg på bordet: {thing}",
  catalogue: "Vad som kan läggas dit", plan: "Bordet uppifrån",
  placed: "{thing}: {right} cm åt höger, {away} cm bort, vriden {turn}°",
  planHint: "Dra sakerna, eller flytta dem med piltangenterna (skift: längre). R vrider, Delete tar bort.",
  wind: "Spola inspelningen", moment: "{at} av {length} s",
  empty: "Ingenting syns.",
  thing: "#{number}, {word}", this: "det här", that: "det där",
  percent: "{percent} %", nameless: "inget ord för den än",
  took: "{seconds} s", tookMs: "{ms} ms", undo: "Ångra", why: "Varför?",
  learned: "lärt: {word}", unlearned: "tillbakataget: {word}",
  rules: "Vad den gjorde", you: "Du", robot: "Roboten",
  again: "Roboten har startats om. Allt den hade bekräftat finns kvar.",
  unconfirmed: "Din sista mening hade den inte bekräftat: den står i fältet och kan sägas igen.",
  anew: "En ny dialog; det som lärts in finns kvar.",
  full: "För många webbläsare tittar på den här sidan.",
  lab: "Titta inuti", inside: "Titta inuti den här turen", timeline: "Tur", changed: "ändrat",
  turn: "Tur {number}: {heard}", noTurn: "Ingen tur har tagits än", looked: "den tittade",
  now: "Tillbaka till nu", replayed: "Som det var: {turn}", on: "vid", when: "när", gone: "Den turen finns inte kvar.",
  unfired: "Regler som inte användes, och varför", insteadOf: "Användes: {rules}. Användes inte:", others: "{count} till väntar på andra händelser.",
  foundNothing: "villkoret gäller, men det som regeln är till för är inte fallet", cameLater: "den hade använts, men en annan kom före",
  rulesCount: "({count})",
  save: "Spara som fil", saveTurn: "Den här turen", saveAll: "Dialogen", dlg: "berättelse (.dlg)", log: "logg", tex: "tillstånd (LaTeX)",
  derivation: "Härledning", shared: "Gemensamt", view: "I bild", private: "Privat", empties: "Tomma: {names}",
  begin: "Klicka på en sak och säg vad den är: ”Det här är en kopp.” Eller fråga: ”Vad är det här?” ”Hjälp.” säger vad mer.",
};

export const TEXTS = { en: EN, sv: SV };

let texts = EN;

export function setLanguage(language) {
  texts = TEXTS[language] ?? EN;
  document.documentElement.lang = language in TEXTS ? language : "en";
}

/** A text with its {slots} filled. */
export function t(name, slots = {}) {
  return texts[name].replace(/\{(\w+)\}/g, (_, slot) => String(slots[slot] ?? ""));
}

/** A number from 0 to 1 in percent. */
export const percent = (degree) => t("percent", { percent: Math.round(degree * 100) });
