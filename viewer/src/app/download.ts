/** Files from the page to the user's disk, and from there. */

/** Offers bytes or a text as a download. */
export function download(content: BlobPart, name: string, type = 'text/plain'): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The browser has taken the file when the task is over, at the latest after some seconds.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
