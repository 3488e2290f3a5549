# Makes a Wine prefix and starts its server; to be sourced: . tests/tools/wine.sh PREFIX
# Wine 8 has no bcryptprimitives.dll, from which Rust's standard library takes random numbers. This one forwards to a function that Wine has.
export WINEPREFIX=$1 WINEDEBUG=-all
mkdir -p "$WINEPREFIX"
# Wine's services start with the first program and would keep its output open, so they are started here without any output.
# A running server is kept.
wineserver -p || true
wineboot --init </dev/null >/dev/null 2>&1
printf '%s\n' '#include <windows.h>' 'BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);' \
  '__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE to, SIZE_T length) { return SystemFunction036(to, (ULONG)length); }' |
  x86_64-w64-mingw32-gcc -shared -x c -o "$WINEPREFIX/drive_c/windows/system32/bcryptprimitives.dll" - -ladvapi32
