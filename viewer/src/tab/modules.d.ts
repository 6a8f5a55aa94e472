/** Address of the WebAssembly module, which the build copies into the page. */
declare module 'periplus-module?url' {
  const url: string;
  export default url;
}
