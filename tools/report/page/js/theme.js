// Light or dark: follows the system until the reader chooses.

const kThemeKey = 'rigel-report-theme';

/** Storage is refused to pages opened from disk in some browsers: the choice then lasts as long as the page. */
function remembered(write) {
  try {
    if (write) localStorage.setItem(kThemeKey, write);
    return localStorage.getItem(kThemeKey);
  } catch {
    return null;
  }
}

function setUpTheme() {
  const button = document.getElementById('theme');
  const systemDark = matchMedia('(prefers-color-scheme: dark)');
  const isDark = () => (document.documentElement.dataset.theme ?? (systemDark.matches ? 'dark' : 'light')) === 'dark';
  const label = () => {
    button.textContent = isDark() ? 'Light theme' : 'Dark theme';
  };
  const before = remembered();
  if (before === 'dark' || before === 'light') document.documentElement.dataset.theme = before;
  button.addEventListener('click', () => {
    document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
    remembered(document.documentElement.dataset.theme);
    label();
  });
  systemDark.addEventListener('change', label);
  label();
}
