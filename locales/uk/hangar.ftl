# Ангар: процеси ArduPilot SITL.

hangar-unknown = екземпляра { $id } немає
hangar-taken = екземпляр { $id } вже є: спершу зупиніть його або виберіть інший номер
hangar-full = працює екземплярів: { $limit }, більше не можна: зупиніть якісь або підніміть межу
hangar-no-program = { $program } не знайдено: назвіть його через --arducopter чи SORTIE_ARDUCOPTER або додайте до PATH
hangar-attached = до екземпляра { $id } вже хтось під'єднаний
hangar-host = не вдається запустити екземпляр { $id }: { $what }: { $error }
hangar-closing = ангар закривається

# Ангари, що є службами деінде.

hangar-far = ангар { $hangar }: { $error }
hangar-far-unreachable = { $address } недосяжний ({ $error }): чи працює там `sortie hangar`? З іншої машини: `ssh -L PORT:127.0.0.1:PORT HOST`
hangar-far-late = { $address } не відповів за { $seconds } с
hangar-far-other = { $address } відповідає, але це не ангар sortie ({ $error })
hangar-far-token = { $address } вимагає свій токен ({ $error }): скопіюйте сюди його файл токена й назвіть його через --hangar-token FILE
