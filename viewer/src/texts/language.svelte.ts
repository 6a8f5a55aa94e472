/** Language of the page: English until the user or the browser chooses another. */
import { en, type Texts } from './en';

export type LanguageName = 'en' | 'de';

export const LANGUAGES: { name: LanguageName; title: string }[] = [
  { name: 'en', title: 'English' },
  { name: 'de', title: 'Deutsch' },
];

const LOADERS: Record<LanguageName, () => Promise<Texts>> = {
  en: async () => en,
  // Loaded when chosen: most pages need one language only.
  de: async () => (await import('./de')).de,
};

const KEY = 'language';

class Language {
  name: LanguageName = $state('en');
  texts: Texts = $state.raw(en);

  /** Loads a language and shows it. */
  async choose(name: LanguageName, isKept = true): Promise<void> {
    this.texts = await LOADERS[name]();
    this.name = name;
    document.documentElement.lang = name;
    if (!isKept) return;
    try {
      localStorage.setItem(KEY, name);
    } catch {
      // Without local storage the language is not remembered.
    }
  }

  /** Chooses the language that was used last, otherwise the first of the browser that there is. */
  async start(): Promise<void> {
    let kept: string | null = null;
    try {
      kept = localStorage.getItem(KEY);
    } catch {
      // Without local storage the browser decides.
    }
    const wanted = [kept, ...navigator.languages].map((one) => one?.slice(0, 2));
    const found = wanted.find((one) => LANGUAGES.some(({ name }) => name === one));
    if (found && found !== 'en') await this.choose(found as LanguageName, false);
  }
}

export const language = new Language();

/** Texts of the present language; reactive where components and `$derived` read it. */
export const t = (): Texts => language.texts;
