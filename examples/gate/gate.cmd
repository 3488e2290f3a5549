@echo off
rem Lets only those G-code programs through in which `pathbuild verify` finds no error: gate.cmd PROGRAM...
rem Programs can also be dropped on it. A program is renamed to PROGRAM.rejected before it is checked, so that it cannot be run meanwhile,
rem and gets its name back if it passes. Otherwise the findings are in PROGRAM.rejected.txt, and the exit status is 1; so they are if
rem pathbuild is missing. PATHBUILD_GATE has options of `verify`: set PATHBUILD_GATE=--surface 0 --require rapids=assumed
setlocal
set status=0
if "%~1"=="" goto unnamed
:next
if "%~1"=="" goto end
if exist "%~f1\*" goto directory
set "held=%~f1.rejected"
move /y "%~f1" "%held%" >nul
if not "%errorlevel%"=="0" goto failed
pathbuild verify %PATHBUILD_GATE% -- "%held%" >"%held%.txt" 2>&1
if not "%errorlevel%"=="0" goto rejected
move /y "%held%" "%~f1" >nul
if not "%errorlevel%"=="0" goto rejected
del "%held%.txt"
shift
goto next
:rejected
type "%held%.txt" 1>&2
echo gate: "%~f1" is now "%held%" 1>&2
goto failed
:directory
echo gate: "%~f1" is a directory 1>&2
:failed
set status=1
shift
goto next
:unnamed
echo gate: no program was named 1>&2
set status=2
:end
exit /b %status%
